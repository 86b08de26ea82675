#!/bin/sh
# Build sdist and wheel, install the wheel into a fresh environment, and test it from outside the repository.
# usage: sh bindings/python/check.sh     at the top of the repository; needs python3 with venv, cc, and PyPI or a mirror
set -eu
top=$(pwd)
build=$top/build/python
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM

rm -rf "$build"
mkdir -p "$build"
python3 -m venv "$build/venv"
"$build/venv/bin/python" -m pip install -q --upgrade pip build

# The sdist is unpacked elsewhere, and the wheel is made of what is in it.
"$build/venv/bin/python" -m build -q --sdist --outdir "$build/dist" bindings/python
"$build/venv/bin/python" -m pip wheel -q --no-deps --wheel-dir "$build/dist" "$build"/dist/libcage-*.tar.gz
wheel=$(echo "$build"/dist/libcage-*-py3-none-*.whl)
echo "built $(basename "$wheel")"
"$build/venv/bin/python" -m pip install -q "$wheel[test]"

cp -R bindings/python/tests bindings/python/bench.py bindings/python/pyproject.toml bindings/python/native examples include README.md "$folder"
cd "$folder"
LIBCAGE_EXAMPLES=$folder/examples/python
LIBCAGE_SOURCES=$folder
LIBCAGE_README=$folder/README.md
export LIBCAGE_EXAMPLES LIBCAGE_SOURCES LIBCAGE_README
if [ -x "$top/build/cage" ]; then
    LIBCAGE_COMMAND=$top/build/cage
    export LIBCAGE_COMMAND
fi
"$build/venv/bin/python" -m mypy --strict --config-file pyproject.toml -p libcage
"$build/venv/bin/python" -m mypy --strict --config-file pyproject.toml tests/typed.py
"$build/venv/bin/python" -m pytest -p no:cacheprovider --durations=5 tests
"$build/venv/bin/python" bench.py
