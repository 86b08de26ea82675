"""The C library: its structs, one table of all its functions, and the check that both are right."""

from __future__ import annotations

import ctypes
import sys
from ctypes import POINTER, c_char_p, c_int32, c_int64, c_size_t, c_uint64, c_void_p
from pathlib import Path
from typing import Any

from .errors import LibraryError, error_of

ABI = 1  # CAGE_ABI of the header that the structs below were copied from

INNER, OUTER, BOTH = 1, 2, 3
REACH = {2: 178956970, 3: 5592405}
QUATERNION = {2: 1 << 30, 3: 1 << 24}
LEVEL_MAX = {2: 14, 3: 11}
NO_CLASS = -1000
OUT_OF_MEMORY, OUT_OF_RANGE = -6, -3


class Ball(ctypes.Structure):
    """cage_ball: four int32, as the rows of an int32 array."""

    _fields_ = [(name, c_int32) for name in "xyzr"]


class Shape(ctypes.Structure):
    """cage_shape: pointers into arrays that the caller keeps alive."""

    _fields_ = [
        ("inner", c_void_p),
        ("outer", c_void_p),
        ("inner_count", c_int32),
        ("outer_count", c_int32),
    ]


class SceneStruct(ctypes.Structure):
    """cage_scene."""

    _fields_ = [("object", Shape), ("obstacles", Shape), ("dim", c_int32)]


class PoseStruct(ctypes.Structure):
    """cage_pose: seven int32, as the rows of an int32 array."""

    _fields_ = [("x", c_int32 * 3), ("q", c_int32 * 4)]


class Limits(ctypes.Structure):
    """cage_limits."""

    _fields_ = [
        ("side", c_int32),
        ("start_level", c_int32),
        ("max_level", c_int32),
        ("max_cells", c_int32),
    ]


class ResultStruct(ctypes.Structure):
    """cage_result; `path` points into the proof's block."""

    _fields_ = [
        ("verdict", c_int32),
        ("reason", c_int32),
        ("level", c_int32),
        ("cells", c_int32),
        ("slices", c_int32 * 2),
        ("gluings", c_int32 * 2),
        ("mixtures", c_int32 * 2),
        ("reached", c_int32 * 2),
        ("balls", c_int64 * 2),
        ("inserted", c_int64 * 2),
        ("steps", c_int64),
        ("peak_bytes", c_uint64),
        ("needed_bytes", c_uint64),
        ("pivot", c_int32 * 3),
        ("path_count", c_int32),
        ("path", POINTER(PoseStruct)),
    ]


class Workers(ctypes.Structure):
    """cage_workers, filled in by cagepy_threads_start."""

    _fields_ = [
        ("count", c_int32),
        ("run", c_void_p),
        ("context", c_void_p),
        ("memory", c_void_p),
        ("bytes", c_size_t),
    ]


class MarginStruct(ctypes.Structure):
    """cage_margin."""

    _fields_ = [
        ("closed", c_int32),
        ("open", c_int32),
        ("proofs", c_int32),
        ("bounded", c_int32),
        ("known", c_int32),
        ("pivot", c_int32 * 3),
        ("narrow", PoseStruct),
    ]


class Plan(ctypes.Structure):
    """cage_plan."""

    _fields_ = [
        ("side", c_int32),
        ("level", c_int32),
        ("max_cells", c_int32),
        ("note", c_int32 * 2),
    ]


class SurveyResult(ctypes.Structure):
    """cage_survey_result."""

    _fields_ = [
        ("level", c_int32),
        ("cells", c_int32),
        ("leaves", c_int32),
        ("slices", c_int32 * 2),
        ("gluings", c_int32 * 2),
        ("mixtures", c_int32 * 2),
        ("classes", c_int32 * 2),
        ("balls", c_int64 * 2),
        ("inserted", c_int64 * 2),
        ("steps", c_int64),
        ("atlas_bytes", c_uint64),
        ("peak_bytes", c_uint64),
        ("needed_bytes", c_uint64),
    ]


class AtlasStruct(ctypes.Structure):
    """cage_atlas; `byte` points at bytes that the caller keeps alive."""

    _fields_ = [
        ("byte", c_void_p),
        ("words", c_int32),
        ("dim", c_int32),
        ("side", c_int32),
        ("classes", c_int32 * 2),
        ("nodes", c_int32 * 2),
        ("leaves", c_int32),
        ("pivot", c_int32 * 3),
        ("note", c_int32 * 2),
    ]


class ClassStruct(ctypes.Structure):
    """cage_class."""

    _fields_ = [
        ("cells", c_int32),
        ("nodes", c_int32),
        ("low", c_int32 * 3),
        ("high", c_int32 * 3),
        ("q", c_int32 * 4),
        ("sine", c_int32),
        ("known", c_int32),
        ("pose", PoseStruct),
    ]


class BoxStruct(ctypes.Structure):
    """cage_atlas_box."""

    _fields_ = [
        ("low", c_int32 * 3),
        ("high", c_int32 * 3),
        ("whole", c_int32),
    ]


class Step(ctypes.Structure):
    """cage_step."""

    _fields_ = [
        ("q", c_int32 * 4),
        ("level", c_int32),
        ("component", c_int32),
        ("pose", c_int32),
    ]


STRUCTS = [
    Ball,
    Shape,
    SceneStruct,
    PoseStruct,
    Limits,
    ResultStruct,
    Workers,
    MarginStruct,
    Plan,
    SurveyResult,
    AtlasStruct,
    ClassStruct,
    BoxStruct,
    Step,
]  # numbered as CAGE_STRUCT_... in cage.h

_p = c_void_p  # any address: an array's, a ctypes.byref, or None

# name: (result, arguments, whether a negative result is an error). Every function of cage.h, and
# of native/cagepy.h.
PROTOTYPES: dict[str, tuple[Any, list[Any], bool]] = {
    "cage_scene_check": (c_int32, [_p], False),
    "cage_collides": (c_int32, [_p, _p, c_int32], True),
    "cage_limits_default": (None, [_p, c_int32], False),
    "cage_prove_size": (c_size_t, [_p, _p], False),
    "cage_prove_begin": (c_int32, [_p, _p, _p, _p, _p, _p, c_size_t], True),
    "cage_prove_begin_small": (c_int32, [_p, _p, _p, _p, _p, _p, c_size_t], True),
    "cage_prove_run": (c_int32, [_p, c_int64], False),
    "cage_prove_run_inner": (c_int32, [_p, c_int64], False),
    "cage_prove_run_with": (c_int32, [_p, c_int64, _p], False),
    "cage_prove_result": (POINTER(ResultStruct), [_p], False),
    "cage_prove_region": (c_int32, [_p, _p, c_int32, _p, _p], True),
    "cage_prove_candidate": (c_int32, [_p, _p, c_int32, _p, c_int32, _p], True),
    "cage_margin_find": (c_int32, [_p, _p, _p, _p, c_int32, _p, c_size_t, _p], False),
    "cage_path_check": (c_int32, [_p, _p, _p, _p, _p, c_int32], True),
    "cage_plan_default": (None, [_p], False),
    "cage_survey_size": (c_size_t, [_p, _p], False),
    "cage_survey_begin": (c_int32, [_p, _p, _p, _p, c_size_t], True),
    "cage_survey_run": (c_int32, [_p, c_int64], False),
    "cage_survey_run_with": (c_int32, [_p, c_int64, _p], False),
    "cage_survey_result_of": (POINTER(SurveyResult), [_p], False),
    "cage_survey_atlas": (c_size_t, [_p, _p, c_size_t], False),
    "cage_survey_facts": (c_size_t, [_p, _p, c_size_t], False),
    "cage_survey_learn": (c_int32, [_p, _p, c_size_t], False),
    "cage_survey_part": (c_int32, [_p, c_int32, c_int32], True),
    "cage_atlas_open": (c_int32, [_p, _p, c_size_t], True),
    "cage_atlas_ask": (c_int32, [_p, _p, _p], True),
    "cage_atlas_locate": (c_int32, [_p, _p, c_int32], False),
    "cage_atlas_class": (c_int32, [_p, c_int32, c_int32, _p], True),
    "cage_atlas_cell": (c_int32, [_p, c_int32, _p, _p], True),
    "cage_atlas_boxes": (c_int64, [_p, c_int32, c_int32, c_int32, c_int32, _p, _p], True),
    "cage_abi": (c_int32, [], False),
    "cage_struct_size": (c_size_t, [c_int32], False),
    "cage_verdict_text": (c_char_p, [c_int32], False),
    "cage_reason_text": (c_char_p, [c_int32], False),
    "cage_error_text": (c_char_p, [c_int32], False),
    "cagepy_ask_many": (None, [_p, _p, _p, c_int64, _p], False),
    "cagepy_locate_many": (None, [_p, _p, c_int64, c_int32, _p], False),
    "cagepy_collides_many": (None, [_p, _p, c_int64, c_int32, _p], False),
    "cagepy_threads_start": (c_void_p, [c_int32, c_uint64, _p], False),
    "cagepy_threads_stop": (None, [_p], False),
    "cagepy_threads_cores": (c_int32, [], False),
}


def _raise_error(result: int, function: Any, _arguments: Any) -> int:
    if result < 0:
        raise failure(result, function.__name__)
    return result


def failure(code: int, where: str) -> Exception:
    """The exception for a negative answer."""
    text: bytes = lib.cage_error_text(code)
    return error_of(code, text.decode(), where)


def prepare(library: Any) -> Any:
    """Set the prototypes of a loaded library, or refuse it if it is not of this ABI."""
    for name, (result, arguments, checked) in PROTOTYPES.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise LibraryError(f"the libcage found has no {name}: reinstall the package") from None
        function.restype = result
        function.argtypes = arguments
        if checked:
            function.errcheck = _raise_error
    if library.cage_abi() != ABI:
        raise LibraryError(
            f"the libcage found has ABI {library.cage_abi()}, this package needs "
            f"{ABI}: reinstall the package"
        )
    for number, struct in enumerate(STRUCTS):
        size = library.cage_struct_size(number)
        if size != ctypes.sizeof(struct):
            raise LibraryError(
                f"{struct.__name__} has {size} bytes in the libcage found and "
                f"{ctypes.sizeof(struct)} here: reinstall the package"
            )
    if library.cage_struct_size(len(STRUCTS)) != 0:
        raise LibraryError("the libcage found knows more structs than this package: reinstall it")
    return library


def library_path() -> Path:
    """The shared library that came with the package."""
    name = "_libcage.dylib" if sys.platform == "darwin" else "_libcage.so"
    path = Path(__file__).with_name(name)
    if not path.is_file():
        raise LibraryError(
            f"{path} is missing: install the package (pip install ./bindings/python)"
            " and import it from elsewhere than its sources"
        )
    return path


lib = prepare(ctypes.CDLL(str(library_path())))  # CDLL: calls release the GIL


def text(function: Any, number: int) -> str:
    """What the library says of a verdict, a reason or an error."""
    words: bytes = function(number)
    return words.decode()
