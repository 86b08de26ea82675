"""A program as a user writes it, for mypy --strict: the public interface has types."""

import numpy as np
from numpy.typing import NDArray

import libcage

scene = libcage.Scene(object=[[0.0, 0.0, 0.04]], obstacles=np.zeros((0, 3)))
result: libcage.Result = scene.prove((0.0, 0.0, 0.0), side="both", max_cells=100)
verdict: libcage.Verdict = result.verdict
poses: NDArray[np.float64] = result.start.matrix()
atlas: libcage.Atlas = scene.atlas(3)
verdicts: NDArray[np.int32] = atlas.query(np.zeros((5, 3)))
margin: libcage.Margin = scene.margin((0, 0, 0), rounds=3)
answers: list[libcage.Result] = libcage.prove_many([libcage.Question(scene, (0, 0, 0))])
both: libcage.Balls = libcage.union([libcage.Balls([[0, 0, 1]]), libcage.Balls([[1, 0, 1]])[:1]])
balls: libcage.Balls = libcage.Balls([[0, 0, 1]], kind="inner")
