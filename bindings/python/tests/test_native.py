"""The table of functions is the headers', and a library that is another one is refused."""

import ctypes
import os
import re
from pathlib import Path

import pytest

from libcage import _native
from libcage.errors import LibraryError

HERE = Path(__file__).parent.parent
TOPS = [
    Path(p) for p in (os.environ.get("LIBCAGE_SOURCES", ""), HERE / "csrc", HERE.parent.parent) if p
]
TOP = next((top for top in TOPS if (top / "include" / "cage.h").is_file()), None)
needs_header = pytest.mark.skipif(TOP is None, reason="no C sources here")


def functions(path):
    """name -> (result, types of the arguments) of every function a header declares."""
    text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S)
    text = re.sub(r"^\s*#.*$", "", text, flags=re.M)
    text = re.sub(r"^typedef [^{;]*\);", "", text, flags=re.M)  # types of functions are none
    found = {}
    for result, name, arguments in re.findall(
        r"([\w ]+?[ *]+)(cage(?:py)?_\w+)\(([^()]*)\);", text
    ):
        parts = [part.strip() for part in arguments.split(",")]
        found[name] = (result.replace("CAGEPY_API", "").strip(), [] if parts == ["void"] else parts)
    return found


def kind(declaration):
    """What ctypes calls the C type."""
    if "*" in declaration or "[" in declaration or "cage_visit" in declaration:
        return "pointer"
    words = declaration.replace("const ", "").split()
    return {
        "int32_t": ctypes.c_int32,
        "int64_t": ctypes.c_int64,
        "uint64_t": ctypes.c_uint64,
        "size_t": ctypes.c_size_t,
        "void": None,
    }[words[0]]


def same(declared, used):
    if declared == "pointer":
        return used in (ctypes.c_void_p, ctypes.c_char_p) or issubclass(used, ctypes._Pointer)
    return declared is used


@needs_header
def test_table_is_the_headers():
    declared = functions(TOP / "include" / "cage.h")
    assert len(declared) >= 26 and "cage_prove_begin" in declared
    native = HERE / "native" / "cagepy.h"
    if native.is_file():
        declared |= functions(native)
    else:
        declared |= {name: None for name in _native.PROTOTYPES if name.startswith("cagepy_")}
    assert set(declared) == set(_native.PROTOTYPES)
    for name, signature in declared.items():
        if signature is None:
            continue
        result, arguments, _ = _native.PROTOTYPES[name]
        assert same(kind(signature[0]), result), name
        assert len(arguments) == len(signature[1]), name
        assert all(same(kind(c), py) for c, py in zip(signature[1], arguments)), name


@needs_header
def test_constants_are_the_headers():
    text = (TOP / "include" / "cage.h").read_text()
    value = {
        name: int(number) for name, number in re.findall(r"#define (CAGE_\w+) \(?(-?\d+)\)?", text)
    }
    assert value["CAGE_ABI"] == _native.ABI
    assert {2: value["CAGE_REACH_2D"], 3: value["CAGE_REACH_3D"]} == _native.REACH
    assert {2: value["CAGE_LEVEL_MAX_2D"], 3: value["CAGE_LEVEL_MAX_3D"]} == _native.LEVEL_MAX
    assert value["CAGE_NO_CLASS"] == _native.NO_CLASS
    structs = {number: name for name, number in value.items() if name.startswith("CAGE_STRUCT_")}
    assert sorted(structs) == list(range(len(_native.STRUCTS)))
    from libcage.errors import ADVICE

    errors = {number for name, number in value.items() if name.startswith("CAGE_ERROR_")}
    assert errors == set(ADVICE)


@needs_header
def test_struct_fields_are_the_headers():
    text = re.sub(r"/\*.*?\*/", "", (TOP / "include" / "cage.h").read_text(), flags=re.S)
    bodies = {
        name: body
        for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", text, flags=re.S)
    }
    names = {
        "Ball": "cage_ball",
        "Shape": "cage_shape",
        "SceneStruct": "cage_scene",
        "PoseStruct": "cage_pose",
        "Limits": "cage_limits",
        "ResultStruct": "cage_result",
        "Workers": "cage_workers",
        "MarginStruct": "cage_margin",
        "Plan": "cage_plan",
        "SurveyResult": "cage_survey_result",
        "AtlasStruct": "cage_atlas",
        "ClassStruct": "cage_class",
        "BoxStruct": "cage_atlas_box",
        "Step": "cage_step",
    }
    for struct in _native.STRUCTS:
        body = re.sub(r"\(\*(\w+)\)\([^;]*\)", r"\1", bodies[names[struct.__name__]])
        body = re.sub(r"\([^()]*\)", "", body)
        fields = [
            re.sub(r"\[\d+\]|[*\s]", "", field.split()[-1])
            for line in body.split(";")
            if line.strip()
            for field in re.sub(
                r"^\s*(const\s+)?(unsigned\s+)?\w+", "", line.strip(), count=1
            ).split(",")
        ]
        assert fields == [name for name, *_ in struct._fields_], struct.__name__


class Fake:
    """A library that answers as the real one, but for what is changed."""

    def __init__(self, **changed):
        self.changed = changed

    def __getattr__(self, name):
        if name in self.changed:
            return self.changed[name]
        return getattr(_native.lib, name)


class Answer:
    def __init__(self, function):
        self.function = function

    def __call__(self, *arguments):
        return self.function(*arguments)


def test_another_abi_is_refused():
    with pytest.raises(LibraryError, match="ABI 2"):
        _native.prepare(Fake(cage_abi=Answer(lambda: 2)))


@pytest.mark.parametrize("which", range(len(_native.STRUCTS)))
def test_another_struct_size_is_refused(which):
    real = _native.lib.cage_struct_size
    with pytest.raises(LibraryError, match="bytes in the libcage found"):
        _native.prepare(Fake(cage_struct_size=Answer(lambda i: real(i) + 8 * (i == which))))


def test_one_struct_more_is_refused():
    real = _native.lib.cage_struct_size
    with pytest.raises(LibraryError, match="more structs"):
        _native.prepare(Fake(cage_struct_size=Answer(lambda i: real(i) or 16)))


def test_a_missing_function_is_refused():
    class Without(Fake):
        def __getattr__(self, name):
            if name == "cage_margin_find":
                raise AttributeError(name)
            return super().__getattr__(name)

    with pytest.raises(LibraryError, match="cage_margin_find"):
        _native.prepare(Without())


def test_the_real_one_is_taken():
    assert _native.prepare(Fake()) is not None
