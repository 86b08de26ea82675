"""Balls for meshes and polygons, made and checked soundly: fit, verify_balls, verify_cover."""

from .fit import Check, Fit, fit, inner_of, verify_balls, verify_cover
from .solids import MeshBoundary, PolygonBoundary

__all__ = [
    "Check",
    "Fit",
    "MeshBoundary",
    "PolygonBoundary",
    "fit",
    "inner_of",
    "verify_balls",
    "verify_cover",
]
