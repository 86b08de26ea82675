"""Polygons and meshes as boundaries: what is refused, and what inside means.

Inside is read so that no reading of a doubtful solid is contradicted: a point is surely inside
where both the even-odd and the nonzero rule say so, surely outside where both do. What lies between
is for inner balls outside, and for outer covers inside."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import SolidError
from ..extras import extra
from .exact import Boundary, Floats


class PolygonBoundary(Boundary):
    """A shapely Polygon or MultiPolygon; several polygons are their union."""

    def __init__(self, shape: Any) -> None:
        with extra("shapes"):
            import shapely

        if shape.geom_type not in ("Polygon", "MultiPolygon"):
            raise SolidError(
                f"a Polygon or MultiPolygon bounds a solid, a {shape.geom_type} does not"
            )
        if shape.is_empty:
            raise SolidError("the polygon is empty")
        parts = [shape] if shape.geom_type == "Polygon" else list(shape.geoms)
        corners, chain = [], []
        self.rings: list[
            tuple[int, list[int]]
        ] = []  # of each polygon the shell's chain and the holes'
        count = 0
        for part in parts:
            numbers = []
            for ring in (part.exterior, *part.interiors):
                points = np.asarray(ring.coords, dtype=np.float64)[:, :2]
                corners.append(np.stack([points[:-1], points[1:]], axis=1))
                chain.append(np.full(len(points) - 1, count))
                numbers.append(count)
                count += 1
            self.rings.append((numbers[0], numbers[1:]))
        all_corners = np.concatenate(corners)
        if not np.isfinite(all_corners).all():
            raise SolidError("a coordinate of the polygon is NaN or infinite")
        if not shape.is_valid:
            raise SolidError(
                f"the polygon is not valid: {shapely.is_valid_reason(shape)}; see "
                "shapely.make_valid"
            )
        super().__init__(all_corners, np.concatenate(chain))

    def surely_inside(self, point: Floats) -> bool:
        turns = self.windings(point)
        return any(
            abs(turns.get(shell, 0)) == 1 and not any(turns.get(hole, 0) for hole in holes)
            for shell, holes in self.rings
        )

    def surely_outside(self, point: Floats) -> bool:
        turns = self.windings(point)
        return all(
            turns.get(shell, 0) == 0 or any(abs(turns.get(hole, 0)) == 1 for hole in holes)
            for shell, holes in self.rings
        )


class MeshBoundary(Boundary):
    """A closed triangle mesh, faces looking outward: a trimesh.Trimesh, or anything with vertices,
    faces."""

    def __init__(self, mesh: Any) -> None:
        vertices = np.asarray(mesh.vertices, dtype=np.float64)
        faces = np.asarray(mesh.faces, dtype=np.int64)
        if vertices.ndim != 2 or vertices.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] != 3:
            raise SolidError("a mesh has vertices of shape (n, 3) and triangles of shape (m, 3)")
        if not len(faces):
            raise SolidError("the mesh has no faces")
        if faces.min() < 0 or faces.max() >= len(vertices):
            raise SolidError("a face names a vertex that is not there")
        if not np.isfinite(vertices[faces]).all():
            raise SolidError("a vertex is NaN or infinite")
        _closed(vertices, faces)
        super().__init__(vertices[faces], np.zeros(len(faces), dtype=np.int64))
        self.vertices, self.faces = vertices, faces
        if self._volume() <= 0:
            raise SolidError(
                "the mesh is inside out, or has no volume: its faces must look outward "
                "(trimesh: mesh.fix_normals() or mesh.invert())"
            )

    def _volume(self) -> int:
        """Six times the volume, signed, exact, in the cube of the integer unit."""
        total = 0
        for a, b, c in self._exact:
            total += (
                a[0] * (b[1] * c[2] - b[2] * c[1])
                - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
            )
        return total

    def surely_inside(self, point: Floats) -> bool:
        return self.windings(point).get(0, 0) == 1

    def surely_outside(self, point: Floats) -> bool:
        return self.windings(point).get(0, 0) == 0


def _closed(vertices: Floats, faces: Any) -> None:
    """Refuse a mesh that is no closed oriented surface: every edge must be run through as often one
    way as the other. Vertices at exactly the same place are one. Only then has every point off
    the surface a winding number."""
    _, same = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    merged = np.asarray(same).reshape(-1)[faces]
    edges = np.concatenate([merged[:, [0, 1]], merged[:, [1, 2]], merged[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    forward = edges[:, 0] < edges[:, 1]
    _, index = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    balance = np.zeros(len(edges), dtype=np.int64)
    np.add.at(balance, np.asarray(index).reshape(-1), np.where(forward, 1, -1))
    open_edges = int((balance != 0).sum())
    if open_edges:
        raise SolidError(
            f"the mesh is not a closed surface with all faces the same way around: {open_edges} "
            "edges have a hole beside them or neighbours turned over (trimesh: mesh.is_watertight, "
            "mesh.is_winding_consistent, trimesh.repair)"
        )


def boundary(solid: Any) -> Boundary:
    """The boundary of a shapely polygon or of a mesh."""
    if isinstance(solid, Boundary):
        return solid
    if hasattr(solid, "geom_type"):
        return PolygonBoundary(solid)
    if hasattr(solid, "vertices") and hasattr(solid, "faces"):
        return MeshBoundary(solid)
    raise SolidError(
        f"a shapely polygon or a mesh with vertices and faces is wanted, not {type(solid).__name__}"
    )
