#!/usr/bin/env python3
"""Write the small scenes: hooked_t/, grasp/ and key/ (walls/ has its own make_walls.py).

Every scene is drawn from a few lengths, and its README says from these lengths what the truth is.
"""

import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, comment, balls):
    with open(os.path.join(FOLDER, name), "w") as out:
        for line in comment:
            out.write("# %s\n" % line)
        out.write("# %d balls: x y r\n" % len(balls))
        for x, y, r in balls:
            out.write("%.6g %.6g %.6g\n" % (x + 0.0, y + 0.0, r))
    print("%-28s %3d balls" % (name, len(balls)))


def row(ax, ay, bx, by, r, spacing):
    """Equal balls from a to b, both ends included, at most that far apart."""
    steps = max(1, math.ceil(math.hypot(bx - ax, by - ay) / spacing - 1e-9))
    return [(ax + (bx - ax) * i / steps, ay + (by - ay) * i / steps, r) for i in range(steps + 1)]


# ---- a T hooked in a slot ---------------------------------------------------------------------------

HEAD = 10.0  # thickness of the T's head
STEM = 6.0   # and of its stem


def hooked_t():
    head = row(-24, 0, 24, 0, HEAD / 2, 4)
    stem = row(0, 3, 0, 42, STEM / 2, 3)
    write("hooked_t/t.xyzr", ["A T: head 58 long and 10 thick, stem 6 thick and 45 long."], head + stem)
    for name, mouth in (("tight", 9.5), ("hooked", 34.0), ("wide", 38.0)):
        write("hooked_t/slot_%s.xyzr" % name,
              ["A slot, 76 wide and 40 deep, with a mouth %g wide." % mouth], slot(76, 40, mouth))


def slot(width, depth, mouth):
    """A box of balls r = 4 around the free rectangle |x| < width/2, -depth/2 < y < depth/2, open in the
    middle of its top."""
    r = 4.0
    x, y, lip = width / 2 + r, depth / 2 + r, mouth / 2 + r
    return (row(-lip, y, -x, y, r, 4)[:-1] + row(-x, y, -x, -y, r, 4)[:-1] + row(-x, -y, x, -y, r, 4)[:-1] +
            row(x, -y, x, y, r, 4)[:-1] + row(x, y, lip, y, r, 4))


# ---- a hexagon between three fingers ----------------------------------------------------------------

FLATS = 40.0  # the hexagon's width across flats, and the diameter of the disc in it
TIP = 8.0     # radius of a finger


def grasp():
    write("grasp/part.xyzr",
          ["A hexagon with rounded corners: %g across flats, and a disc of that diameter in it." % FLATS], hexagon())
    for name, gap in (("closed", 39.0), ("open", 41.5)):
        write("grasp/fingers_%s.xyzr" % name, ["Three fingers; their tips leave gaps of %g." % gap], fingers(gap))


def hexagon():
    r = 4.0
    corner = (FLATS / 2 - r) / math.cos(math.pi / 6)
    points = [(corner * math.cos(k * math.pi / 3), corner * math.sin(k * math.pi / 3)) for k in range(6)]
    balls = [(0.0, 0.0, FLATS / 2)]
    for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
        balls += row(ax, ay, bx, by, r, 5)[:-1]
    return balls


def fingers(gap):
    """Tips at the corners of an equilateral triangle; each finger goes outward, then bends."""
    balls = []
    tip = (gap + 2 * TIP) / math.sqrt(3)
    for k in range(3):
        angle = math.pi / 2 + 2 * math.pi * k / 3
        ax, ay = tip * math.cos(angle), tip * math.sin(angle)
        bx, by = ax + 28 * math.cos(angle), ay + 28 * math.sin(angle)
        cx, cy = bx + 30 * math.cos(angle + 0.5), by + 30 * math.sin(angle + 0.5)
        balls += row(ax, ay, bx, by, TIP, 4) + row(bx, by, cx, cy, TIP, 4)[1:]
    return balls


# ---- a key in a lock -------------------------------------------------------------------------------

BLADE = 12.0   # height of the key's blade
NOTCH = 6.0    # height that is left of it in a notch
KEYWAY = 12.7  # height of the keyway
PIN = 1.5      # how far above the middle of the keyway a pin ends that is down


def key():
    blade = row(-30, 0, -15, 0, BLADE / 2, 3) + row(1, 0, 7, 0, BLADE / 2, 3) + row(23, 0, 36, 0, BLADE / 2, 3)
    low = -(BLADE - NOTCH) / 2
    notches = row(-12, low, -2, low, NOTCH / 2, 2) + row(10, low, 20, low, NOTCH / 2, 2)
    bow = [(54 + 15 * math.cos(k * math.pi / 10), 15 * math.sin(k * math.pi / 10), 4.0) for k in range(20)]
    write("key/key.xyzr", ["A key: a blade %g high with two notches that leave %g, and a ring to hold it." %
                           (BLADE, NOTCH)], blade + notches + bow)
    write("key/lock_locked.xyzr", ["A lock, its keyway %g high, both pins down." % KEYWAY], lock(PIN))
    write("key/lock_open.xyzr", ["A lock, its keyway %g high, both pins lifted." % KEYWAY], lock(KEYWAY / 2))


def lock(pin):
    r, y, end = 3.0, KEYWAY / 2 + 3.0, -42.0
    walls = row(end, y, 32, y, r, 2) + row(end, -y, 32, -y, r, 2) + row(end, -y, end, y, r, 2)[1:-1]
    pins = row(-7, pin + 2.5, -7, 16, 2.5, 2) + row(15, pin + 2.5, 15, 16, 2.5, 2)
    return walls + pins


if __name__ == "__main__":
    hooked_t()
    grasp()
    key()
