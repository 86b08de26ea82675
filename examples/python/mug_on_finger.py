"""A gripper and a mug, from the side: a finger goes through the handle, a stop is behind.

Mug and fingers are polygons; balls are made for both, inner ones proved to lie inside and outer
ones proved to cover. The handle is whole, or has a gap that is narrower or wider than the finger:
with the wide one the mug can leave."""

import sys

import shapely
from shapely.geometry import Point, box

import libcage
from libcage import plot

FINGER = 0.006  # radius, metres


def mug(gap: float) -> shapely.Polygon:
    """80 mm wide, 90 mm high, the wall's section left out: seen from the side it is full. The
    handle is a ring of 12 mm with a gap in the middle of its right side."""
    body = box(-0.040, 0.0, 0.040, 0.090)
    handle = Point(0.040, 0.045).buffer(0.034, 32).difference(Point(0.040, 0.045).buffer(0.022, 32))
    whole = body.union(handle)
    if gap:
        whole = whole.difference(box(0.045, 0.045 - gap / 2, 0.100, 0.045 + gap / 2))
    return whole


def gripper() -> shapely.MultiPolygon:
    """Two fingertips: one in the handle, one 50 mm behind the body."""
    return shapely.MultiPolygon(
        [Point(0.051, 0.045).buffer(FINGER, 16), Point(-0.090, 0.045).buffer(FINGER, 16)]
    )


def main(picture: str = "") -> dict:
    fingers = libcage.fit(gripper(), count=30, outer_tolerance=0.0005)
    print("fingers:", fingers)
    found = {}
    for gap in (0.0, 0.008, 0.026):
        part = libcage.fit(mug(gap), count=220, outer_tolerance=0.002, samples=3000)
        scene = libcage.Scene(part, fingers)
        answer = scene.prove((0.0, 0.0, 0.0))
        found[gap] = answer
        print(
            f"gap {1e3 * gap:.0f} mm: {answer.verdict}, "
            f"{len(part.inner)} inner balls, {len(part.outer)} outer"
        )
        if picture and answer.path is not None:
            plot.result(scene, answer).figure.savefig(picture, dpi=120)
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
