"""What Python adds to C, side by side: to a proof (100 us allowed), to 100 000 questions (1.3)."""

import ctypes
import time

import numpy as np

from libcage import Scene, _native

FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])


def best(function, rounds, repeats):
    """Seconds of this thread a call, the least of some rounds: others work on the machine too."""
    least = np.inf
    for _ in range(rounds):
        begun = time.thread_time()
        for _ in range(repeats):
            function()
        least = min(least, (time.thread_time() - begun) / repeats)
    return least


def proofs():
    """Seconds that a proof takes in C alone, and from Python."""
    scene = Scene([[0, 0, 0.04]], FINGERS)
    proof, lib = scene.begin((0, 0, 0)), _native.lib
    block, handle = np.empty(proof._size, dtype=np.uint8), ctypes.c_void_p()
    start = proof.start.ctypes.data

    def in_c():
        lib.cage_prove_begin(
            ctypes.byref(handle),
            ctypes.byref(proof.grid.struct),
            start,
            None,
            ctypes.byref(proof.limits),
            block.ctypes.data,
            len(block),
        )
        assert lib.cage_prove_run(handle, 1 << 40) == 1

    alone = whole = np.inf
    for _ in range(8):  # the machine may be busy: the least that is ever seen of each, in turns
        alone = min(alone, best(in_c, 5, 100))
        whole = min(whole, best(lambda: scene.prove((0, 0, 0)), 5, 100))
    return alone, whole


def questions():
    """The same of 100 000 poses of an atlas."""
    scene = Scene([[0, 0, 0.03], [0.05, 0, 0.02]], FINGERS * 1.3)
    atlas = scene.atlas(6)
    poses = np.random.default_rng(1).uniform([-0.2, -0.2, -4], [0.2, 0.2, 4], (100_000, 3))
    rows, out = atlas._rows(poses), np.empty(len(poses), dtype=np.int32)

    def in_c():
        _native.lib.cagepy_ask_many(
            ctypes.byref(atlas._struct), rows.ctypes.data, None, len(rows), out.ctypes.data
        )

    alone = best(in_c, 7, 1)
    whole = best(lambda: atlas.query(poses), 7, 1)
    assert np.array_equal(out, atlas.query(poses))
    return alone, whole


if __name__ == "__main__":
    in_c, python = proofs()
    print(f"a proof: C {1e6 * in_c:.0f} us, Scene.prove {1e6 * (python - in_c):.0f} us more")
    in_c, python = questions()
    print(f"100 000 poses: C {1e3 * in_c:.1f} ms, Atlas.query {python / in_c:.2f} times that")
