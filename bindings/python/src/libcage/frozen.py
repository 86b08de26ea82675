"""What cannot change: objects whose attributes are set once, arrays that nobody can write to."""

from __future__ import annotations

import math
import operator
from typing import Any, NoReturn

import numpy as np

from .errors import InputError


class Frozen:
    """A base for immutable objects: attributes are set in __init__, by _set, and then stay."""

    __slots__ = ()

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} objects are immutable: make another one")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} objects are immutable: make another one")

    def _set(self, **values: object) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)


def frozen_array(values: Any) -> Any:
    """A C-contiguous copy of an array in memory that no flag makes writable again."""
    return np.ndarray(values.shape, values.dtype, np.ascontiguousarray(values).tobytes())


def is_masked(values: Any) -> bool:
    """Is it a masked array, or a list of them? What the mask hides would come back as numbers."""
    if isinstance(values, (list, tuple)):
        return any(isinstance(value, np.ma.MaskedArray) for value in values)
    return isinstance(values, np.ma.MaskedArray)


def real_number(value: Any, what: str) -> float:
    """A number that is not NaN, or an InputError that says what it is for."""
    try:
        number = float(value) if not isinstance(value, (str, bytes)) else math.nan
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if math.isnan(number):
        raise InputError(f"{what}: a number is wanted, not {value!r}")
    return number


def whole(value: Any, what: str, low: int, high: int) -> int:
    """A whole number in that range, or an InputError that says which is wanted."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{what}: a whole number is wanted, not {value!r}") from None
    if not low <= number <= high:
        raise InputError(f"{what}: {low} to {high}, not {value!r}")
    return number
