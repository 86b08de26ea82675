"""A planner and a proof side by side on one question: whichever has an answer first decides.

A sampling planner finds paths and cannot tell that there is none: on such a question it reports
Timeout, or an approximate solution. The proof runs beside it in a thread, outside the GIL."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .extras import extra
from .poses import PoseLike
from .proof import PORTION
from .result import Result
from .scene import Scene


@dataclass(frozen=True)
class Race:
    """What came out: `status` of the planner (OMPL: PlannerStatus, INFEASIBLE where the proof says
    so), and the proof's Result, or None where the planner was first. `error`: why there is no
    proof, where the proof failed (memory, say) while the planner had an answer."""

    status: Any
    proof: Result | None
    error: BaseException | None = None


class Prover:
    """A proof running in a thread of its own until it is finished or stopped."""

    def __init__(
        self, scene: Scene, start: PoseLike, goal: PoseLike | None = None, **options: Any
    ) -> None:
        self._proof = scene.begin(start, goal, **options)
        self._stop = threading.Event()
        self.result: Result | None = None
        self.error: BaseException | None = None
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def _work(self) -> None:
        try:
            with self._proof as proof:
                steps = 64
                while not self._stop.is_set():
                    before = proof.seconds
                    if proof.run(steps):
                        self.result = proof.result()
                        return
                    steps = (
                        steps * 2 if proof.seconds - before < PORTION / 2 else max(64, steps // 2)
                    )
        except BaseException as error:
            self.error = error

    def separated(self) -> bool:
        """Is it proved by now that there is no path?"""
        return self.result is not None and self.result.verdict.separated

    def stop(self) -> Result | None:
        """End the thread, after its portion of steps; the Result if there is one, else see
        `error`."""
        self._stop.set()
        self._thread.join()
        return self.result


def race(
    solve: Callable[[Callable[[], bool]], Any],
    scene: Scene,
    start: PoseLike,
    goal: PoseLike | None = None,
    infeasible: Any = None,
    **options: Any,
) -> Race:
    """Run solve(terminate), a planner that stops when terminate() is true, beside a proof.

    When the proof says that there is no path, terminate() becomes true and the status is
    `infeasible`. options: of Scene.begin.
    """
    prover = Prover(scene, start, goal, **options)
    try:
        status = solve(prover.separated)
    finally:
        proof = prover.stop()
    if proof is not None and proof.verdict.separated:
        return Race(infeasible, proof)
    if prover.error is not None and not status:
        raise prover.error
    return Race(status, proof, prover.error)


def race_ompl(
    planner: Any,
    scene: Scene,
    start: PoseLike,
    goal: PoseLike | None = None,
    seconds: float = 60.0,
    **options: Any,
) -> Race:
    """race with a planner of OMPL that has its problem set: solve until solved, proved, or timed
    out.

    The status is OMPL's own; PlannerStatus.INFEASIBLE when the proof landed first. start and goal
    must be those of the planner's problem, and its validity checker must answer for the same balls.
    """
    import time

    with extra("planner"):
        from ompl import base

    end = time.monotonic() + seconds

    def solve(separated: Callable[[], bool]) -> Any:
        return planner.solve(
            base.PlannerTerminationCondition(lambda: separated() or time.monotonic() > end)
        )

    kinds = getattr(base.PlannerStatus, "PlannerStatusType", base.PlannerStatus)
    return race(solve, scene, start, goal, base.PlannerStatus(kinds.INFEASIBLE), **options)
