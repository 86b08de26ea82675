"""libcage: prove that a rigid object is caged, or that no path joins two poses, or find the path.

    from libcage import Scene
    fingers = [[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]]
    print(Scene(object=[[0, 0, 0.04]], obstacles=fingers).prove((0, 0, 0)).verdict)   # CAGED

Metres and radians. Doubles are put on an integer grid, balls to the safe side and poses to the
nearest; every verdict but UNDEFINED is a theorem about these, decided in exact integers."""

from ._native import ABI
from .atlas import NO_CLASS, Atlas, Class
from .balls import Balls, Solid, union
from .errors import (
    AtlasError,
    CageError,
    GridError,
    InputError,
    KindError,
    LibraryError,
    MissingError,
    OutOfMemoryError,
    PoseError,
    SolidError,
)
from .formats import read, read_links, write
from .many import Question, prove_many
from .poses import Pose, Poses, from_matrices, from_wxyz, from_xytheta, from_xyzw
from .proof import Proof
from .result import Margin, Path, Result, Statistics, Verdict
from .scene import Scene
from .shapes import Check, Fit, fit, verify_balls, verify_cover

__version__ = "0.1.0"

__all__ = [
    "ABI",
    "NO_CLASS",
    "Atlas",
    "AtlasError",
    "Balls",
    "CageError",
    "Check",
    "Class",
    "Fit",
    "GridError",
    "InputError",
    "KindError",
    "LibraryError",
    "Margin",
    "MissingError",
    "OutOfMemoryError",
    "Path",
    "Pose",
    "PoseError",
    "Poses",
    "Proof",
    "Question",
    "Result",
    "Scene",
    "Solid",
    "SolidError",
    "Statistics",
    "Verdict",
    "fit",
    "from_matrices",
    "from_wxyz",
    "from_xytheta",
    "from_xyzw",
    "prove_many",
    "read",
    "read_links",
    "union",
    "verify_balls",
    "verify_cover",
    "write",
]
