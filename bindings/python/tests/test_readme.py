"""The Python shown in the README runs, and prints what is shown after it."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PLACE = Path(os.environ.get("LIBCAGE_README", Path(__file__).parents[3] / "README.md"))


@pytest.mark.skipif(not PLACE.is_file(), reason="the README is in the repository")
def test_readme(tmp_path):
    blocks = re.findall(r"```python\n(.*?)```\s*```text\n(.*?)```", PLACE.read_text(), flags=re.S)
    assert blocks
    for program, printed in blocks:
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        assert done.stdout == printed
