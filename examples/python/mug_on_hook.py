"""A mug of meshes hangs on a hook: the way off, as an interactive picture in one HTML file.

usage: python mug_on_hook.py [mug.html]
"""

import sys

import numpy as np
import trimesh

import libcage
from libcage import view


def middle(mesh: trimesh.Trimesh, place: list) -> trimesh.Trimesh:
    """The mesh, moved so that the middle of its box is there."""
    mesh.apply_translation(np.array(place) - mesh.bounds.mean(axis=0))
    return mesh


def mug() -> trimesh.Trimesh:
    """A round full cup and a handle; the parts overlap, which is fine."""
    cup = trimesh.creation.capsule(0.030, 0.036, count=[16, 16])
    handle = trimesh.creation.torus(0.022, 0.005, major_sections=24, minor_sections=10)
    handle.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    return trimesh.util.concatenate([middle(cup, [0, 0, 0]), middle(handle, [0.056, 0, 0])])


def hook() -> trimesh.Trimesh:
    """An arm through the handle: one end free, at the other a tip that points up."""
    arm = trimesh.creation.capsule(0.080, 0.006, count=[12, 12])
    arm.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    tip = trimesh.creation.capsule(0.006, 0.006, count=[12, 12])
    parts = [middle(arm, [0.056, -0.005, 0]), middle(tip, [0.056, -0.045, 0.003])]
    return trimesh.util.concatenate(parts)


def main(html: str = "") -> libcage.Result:
    part = libcage.fit(mug(), count=120, outer_tolerance=0.004)
    bracket = libcage.fit(hook(), count=60, outer_tolerance=0.002)
    print("mug:", part)
    print("hook:", bracket)
    scene = libcage.Scene(part, bracket)
    answer = scene.prove(np.eye(4), side="outer")
    print(answer)
    if html:
        view.write_html(html, scene, answer)
    return answer


if __name__ == "__main__":
    main(*sys.argv[1:2])
