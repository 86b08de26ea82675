"""A planner of OMPL and a proof side by side: it stops with INFEASIBLE when the proof lands.

A plus-shaped part in the rooms of examples/walls. One goal can be reached; the other lies in
another room, and a planner alone would look for a way until its time is up."""

import math
from pathlib import Path

from ompl import base, geometric, util

import libcage
from libcage.planner import race_ompl

WALLS = Path(__file__).resolve().parent.parent / "walls"


def planner_for(scene: libcage.Scene, start: tuple, goal: tuple) -> geometric.RRTConnect:
    """RRT-Connect in the plane; states are checked with the same balls that the proof is about."""
    space = base.SE2StateSpace()
    bounds = base.RealVectorBounds(2)
    bounds.setLow(0)
    bounds.setHigh(500)
    space.setBounds(bounds)
    information = base.SpaceInformation(space)
    information.setStateValidityChecker(
        lambda state: not scene.collides([[state.getX(), state.getY(), state.getYaw()]])[0]
    )
    information.setup()
    problem = base.ProblemDefinition(information)
    states = []
    for x, y, theta in (start, goal):
        state = space.allocState()
        state.setX(x)
        state.setY(y)
        state.setYaw(theta)
        states.append(state)
    problem.setStartAndGoalStates(*states)
    planner = geometric.RRTConnect(information)
    planner.setProblemDefinition(problem)
    planner.setup()
    return planner


def main() -> dict:
    util.setLogLevel(util.LogLevel.LOG_ERROR)
    scene = libcage.Scene(
        libcage.read(WALLS / "plus.xyzr", kind="exact"),
        libcage.read(WALLS / "walls_R4.xyzr", kind="exact"),
    )
    hall = (300.0, 320.0, math.pi / 4)
    found = {}
    for name, goal in (
        ("hall to hall", (390.0, 300.0, 0.35)),
        ("hall to chamber", (185.0, 195.0, math.pi / 4)),
    ):
        alone = planner_for(scene, hall, goal).solve(2.0)
        both = race_ompl(planner_for(scene, hall, goal), scene, hall, goal, seconds=60)
        found[name] = (alone.getStatus().name, both.status.getStatus().name, both.proof)
        verdict = "the planner was first" if both.proof is None else str(both.proof.verdict)
        print(
            f"{name}: the planner alone: {found[name][0]}; "
            f"beside a proof: {found[name][1]} ({verdict})"
        )
    return found


if __name__ == "__main__":
    main()
