"""Packages that only some functions need: where one is missing, which to install is said."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .errors import MissingError

PACKAGES = {"igl": "libigl", "yaml": "PyYAML"}  # where the package is not named as the module


@contextmanager
def extra(name: str) -> Iterator[None]:
    """Around imports: a module that is not there becomes an error that names the extra to
    install."""
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "a module").partition(".")[0]
        raise MissingError(
            f"{PACKAGES.get(module, module)} is not installed: pip install 'libcage[{name}]'"
        ) from error
