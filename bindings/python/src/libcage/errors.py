"""The exceptions: each says what is wrong and what to do about it."""

from __future__ import annotations


class CageError(Exception):
    """Anything that libcage refuses. `code` is the C library's error number, or 0."""

    def __init__(self, message: str, code: int = 0) -> None:
        super().__init__(message)
        self.message = message
        self.code = code

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.message, self.code)


class InputError(CageError, ValueError):
    """Arrays, shapes or numbers that cannot be used as they are."""


class PoseError(InputError):
    """A pose that is no rigid motion, of the other dimension, or beyond the grid."""


class GridError(InputError):
    """The scene does not fit the integer grid at the unit that was asked for."""


class KindError(InputError):
    """Balls of that kind (inner, outer, exact, unknown) cannot carry the answer asked for."""


class SolidError(InputError):
    """A mesh or polygon that bounds no solid: holes, inside out, NaN."""


class AtlasError(CageError):
    """Bytes that are no atlas of this version, or were changed."""


class OutOfMemoryError(CageError, MemoryError):
    """The block of memory allowed was too small. `needed` bytes would be tried next."""

    def __init__(self, message: str, code: int = -6, needed: int = 0) -> None:
        super().__init__(message, code)
        self.needed = needed

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.message, self.code, self.needed)


class MissingError(CageError, ImportError):
    """A package is not installed that only some functions need."""


class LibraryError(ImportError):
    """The C library that was found is not the one this package was made for."""


ADVICE = {
    -1: "an argument is null, negative or unknown; please report how this came about",
    -2: "use dim 2 with balls x y r, or dim 3 with balls x y z r, not both",
    -3: "choose a larger unit, or leave unit out; poses must lie within the grid",
    -4: "a radius is negative; remove the ball, or mend the radius",
    -5: "the rotation is zero, too large, or not about z in the plane",
    -6: "allow more memory (memory=...), or lower max_cells",
    -7: "the bytes are no atlas of this version, or were changed; make it again",
}

CLASSES: dict[int, type[CageError]] = {
    -3: GridError,
    -4: InputError,
    -5: PoseError,
    -6: OutOfMemoryError,
    -7: AtlasError,
}


def error_of(code: int, text: str, where: str) -> CageError:
    """The exception for a negative answer of the C function `where`."""
    advice = ADVICE.get(code, "unknown error")
    return CLASSES.get(code, CageError)(f"{where}: {text} ({code}). {advice}.", code)
