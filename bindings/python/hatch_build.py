"""The build hook: compiles the C library into the wheel, and puts the C sources into the sdist."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FLAGS = ["-std=c99", "-D_POSIX_C_SOURCE=200809L", "-O3", "-fPIC", "-shared", "-fvisibility=hidden"]


def sources(root: Path) -> Path:
    """The folder with src/ and include/: the repository, or csrc/ of an unpacked sdist."""
    for top in (root / "csrc", root.parent.parent):
        if (top / "include" / "cage.h").is_file() and (top / "src").is_dir():
            return top
    raise RuntimeError(f"no C sources: neither {root / 'csrc'} nor {root.parent.parent} has them")


def needed(root: Path) -> dict[str, str]:
    """Every file that compiling and the licence need: where it is, and its place in the sdist."""
    top = sources(root)
    files = [top / "include" / "cage.h", *sorted((top / "src").glob("*.[ch]"))]
    files += [top / "src" / "host" / name for name in ("threads.c", "threads.h")]
    files += [top / "LICENSE"]
    return {str(path): "csrc/" + path.relative_to(top).as_posix() for path in files}


def compiler() -> list[str]:
    """CC, or the first of the usual names that is there."""
    if "CC" in os.environ:
        return shlex.split(os.environ["CC"])
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name):
            return [name]
    raise RuntimeError("libcage is built from C: install a C compiler (cc), or set CC")


def compile_library(root: Path, target: Path) -> None:
    """One shared library of the core, its threads, and the helpers in native/."""
    top = sources(root)
    files = [*sorted((top / "src").glob("*.c")), top / "src" / "host" / "threads.c"]
    files += sorted((root / "native").glob("*.c"))
    command = [*compiler(), *FLAGS, f"-I{top / 'include'}", f"-I{top / 'src' / 'host'}"]
    subprocess.run([*command, *map(str, files), "-pthread", "-o", str(target)], check=True)


class Hook(BuildHookInterface[Any]):
    """Called by hatchling for the wheel and for the sdist."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        root = Path(self.root)
        if self.target_name == "sdist":
            build_data["force_include"].update(needed(root))
            return
        if os.name == "nt":
            raise RuntimeError("libcage builds on POSIX systems; on Windows use WSL")
        self.folder = tempfile.mkdtemp()
        name = "_libcage.dylib" if sys.platform == "darwin" else "_libcage.so"
        library = Path(self.folder) / name
        compile_library(root, library)
        build_data["force_include"][str(library)] = f"libcage/{name}"
        build_data["force_include"][str(sources(root) / "LICENSE")] = "libcage/LICENSE"
        if version == "editable":
            shutil.copy2(library, root / "src" / "libcage" / name)
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact: str) -> None:
        if hasattr(self, "folder"):
            shutil.rmtree(self.folder, ignore_errors=True)
