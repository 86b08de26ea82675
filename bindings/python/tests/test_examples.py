"""The examples run, and say what must be true of their scenes, for reasons given in them."""

import importlib
import os
import sys
from pathlib import Path

import numpy as np
import pytest

import libcage
from libcage import Verdict

PLACE = Path(os.environ.get("LIBCAGE_EXAMPLES", Path(__file__).parents[3] / "examples" / "python"))
pytestmark = pytest.mark.skipif(not PLACE.is_dir(), reason="the examples are in the repository")
sys.path.insert(0, str(PLACE))


def example(name):
    return importlib.import_module(name)


def test_peg_in_hole_goes_in_exactly_with_clearance():
    assert {c: v for c, v in example("peg_in_hole").main().items()} == {
        c: Verdict.CONNECTED if c > 0 else Verdict.DISCONNECTED
        for c in (-5e-4, -1e-4, -2e-5, 2e-5, 1e-4, 5e-4)
    }


def test_mug_leaves_the_finger_only_through_the_wide_gap(tmp_path):
    found = example("mug_on_finger").main(str(tmp_path / "mug.png"))
    # The finger's diameter is 12 mm; the gaps are 0, 8 and 26 mm, and the way to the left is clear.
    assert [answer.verdict for answer in found.values()] == [
        Verdict.CAGED,
        Verdict.CAGED,
        Verdict.FREE,
    ]
    assert (tmp_path / "mug.png").stat().st_size > 10_000


def test_molecules():
    found = example("molecule_in_cage").main()
    atoms = example("molecule_in_cage").c60()
    assert len(atoms) == 60
    gaps = np.sort(np.linalg.norm(atoms[:, None] - atoms[None], axis=2), axis=1)
    assert np.allclose(gaps[:, 1:4], 1.42) and (gaps[:, 4] > 2).all()  # each atom has three bonds
    assert found["hydrogen"].verdict is Verdict.CAGED
    assert found["margin"].closed <= 0.84 <= found["margin"].open  # see the example
    assert found[2].verdict is Verdict.CAGED
    assert found[16].verdict is Verdict.FREE


def test_grasps_are_ranked():
    module = example("screen_grasps")
    found = module.main()
    assert len(found) == 200
    for seed, closed, opened in found[:25]:  # asked again, shrunk as the margin says
        if closed is None or closed <= 0:
            continue
        for by, wanted in ((closed * 0.99, Verdict.CAGED), (opened * 1.01, Verdict.FREE)):
            part, fingers = module.PART.copy(), module.grasp(seed)
            part[:, 2] -= by
            fingers[:, 2] -= by
            assert libcage.Scene(part, fingers).prove((0, 0, 0)).verdict is wanted
    assert any(closed is not None and closed > 0 for _, closed, _ in found)


def test_mug_leaves_the_hook(tmp_path):
    answer = example("mug_on_hook").main(str(tmp_path / "mug.html"))
    assert answer.verdict is Verdict.FREE
    assert "plotly" in (tmp_path / "mug.html").read_text()[:2_000_000].lower()


def test_planner_and_proof():
    pytest.importorskip("ompl")
    found = example("planner_and_proof").main()
    assert found["hall to hall"][1] == "EXACT_SOLUTION"
    alone, beside, proof = found["hall to chamber"]
    assert alone in ("TIMEOUT", "APPROXIMATE_SOLUTION")
    assert beside == "INFEASIBLE" and proof.verdict is Verdict.DISCONNECTED


def test_notebook():
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(PLACE / "quickstart.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    printed = "".join(str(cell.get("outputs", "")) for cell in notebook.cells)
    assert "CAGED: " in printed and "image/png" in printed
