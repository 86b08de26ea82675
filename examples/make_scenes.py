#!/usr/bin/env python3
"""Write the small scenes: hooked_t/, grasp/, key/ and space/ (walls/ has its own make_walls.py).

Every scene is drawn from a few lengths, and its README says from these lengths what the truth is.
"""

import math
import os
import random

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, comment, balls):
    with open(os.path.join(FOLDER, name), "w") as out:
        for line in comment:
            out.write("# %s\n" % line)
        out.write("# %d balls: %s r\n" % (len(balls), " ".join("xyz"[:len(balls[0]) - 1])))
        for ball in balls:
            out.write(" ".join("%.6g" % (round(number, 12) + 0.0) for number in ball) + "\n")
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


# ---- space: spheres, rings and rows of balls -------------------------------------------------------------

def sphere(count, radius, r, centre=(0.0, 0.0, 0.0), keep=lambda x, y, z: True):
    """Equal balls, evenly on a sphere (a Fibonacci lattice), but for those that keep leaves out."""
    balls = []
    for i in range(count):
        z, angle = 1 - (2 * i + 1) / count, i * math.pi * (3 - math.sqrt(5))
        at = (radius * math.sqrt(1 - z * z) * math.cos(angle), radius * math.sqrt(1 - z * z) * math.sin(angle), radius * z)
        if keep(*at):
            balls.append((at[0] + centre[0], at[1] + centre[1], at[2] + centre[2], r))
    return balls


def ring(count, radius, r, axis, centre=(0.0, 0.0, 0.0), begin=0.0, end=2 * math.pi):
    """Balls on a circle around an axis (0, 1, 2) through the centre; with an end that is less than a turn, on an arc."""
    balls = []
    for i in range(count):
        angle = begin + (end - begin) * i / (count if end - begin > 6.28 else count - 1)
        at = list(centre)
        at[(axis + 1) % 3] += radius * math.cos(angle)
        at[(axis + 2) % 3] += radius * math.sin(angle)
        balls.append((at[0], at[1], at[2], r))
    return balls


def bar(a, b, r, spacing):
    steps = max(1, math.ceil(math.dist(a, b) / spacing - 1e-9))
    return [tuple(a[k] + (b[k] - a[k]) * i / steps for k in range(3)) + (r,) for i in range(steps + 1)]


def turned(q, ball):
    """The ball turned by the unit quaternion q."""
    w, v, p = q[0], q[1:], ball[:3]
    u = [2 * (v[(k + 1) % 3] * p[(k + 2) % 3] - v[(k + 2) % 3] * p[(k + 1) % 3]) for k in range(3)]
    return tuple(p[k] + w * u[k] + v[(k + 1) % 3] * u[(k + 2) % 3] - v[(k + 2) % 3] * u[(k + 1) % 3]
                 for k in range(3)) + (ball[3],)


def moved(pose, balls):
    """Balls of the object at a pose (x, y, z, qw, qx, qy, qz)."""
    return [tuple(c + x for c, x in zip(turned(pose[3:], ball)[:3], pose)) + (ball[3],) for ball in balls]


def clearance(balls, obstacles):
    return min(math.dist(a[:3], b[:3]) - a[3] - b[3] for a in balls for b in obstacles)


def check_closed(radius, centre, obstacles, r):
    """No ball of radius r can have its centre on the sphere: then none that is inside gets out. Points are tested; every
    point of the sphere is within 3 / sqrt(count) radii of one of them."""
    count = 8000
    for x, y, z, _ in sphere(count, radius, 0, centre):
        assert clearance([(x, y, z, r)], obstacles) < -3 * radius / math.sqrt(count), (x, y, z)


def check_way(poses, balls, obstacles, least):
    for pose in poses:
        assert clearance(moved(pose, balls), obstacles) >= least, (pose, clearance(moved(pose, balls), obstacles))


def about(axis, degrees):
    """The quaternion of a turn about an axis (0, 1, 2)."""
    q = [math.cos(math.radians(degrees) / 2), 0.0, 0.0, 0.0]
    q[1 + axis] = math.sin(math.radians(degrees) / 2)
    return tuple(q)


HOME = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
POSES = []  # lines of space/poses.txt


def pose_named(name, pose):
    POSES.append("%-14s %s" % (name, ",".join("%.9g" % (x + 0.0) for x in pose)))


# ---- space: things in shells -------------------------------------------------------------------------------

def shell():
    """No hole of the shell lets a ball of the guest out; holes of the sieve let it through, one ball after the other."""
    guest = [(-0.15, 0, 0, 0.1), (0.15, 0, 0, 0.1)]
    write("space/guest.xyzr", ["Two small balls, apart."], guest)
    closed = sphere(200, 2, 0.5)
    check_closed(2, HOME, closed, 0.1)
    write("space/shell.xyzr", ["A closed shell of radius 2."], closed)
    motion = (1.0, -2.0, 0.5, 0.5, 0.1, -0.7, 0.5)
    write("space/shell_moved.xyzr", ["The shell, turned and moved: pose shell_moved."], moved(motion, closed))
    pose_named("shell_moved", motion)
    dice = random.Random(1)
    sieve = [tuple(c + 2 * 0.05 * dice.uniform(-1, 1) for c in ball[:3]) + (0.1,) for ball in closed]
    write("space/sieve.xyzr", ["The same shell of balls so small that there are holes, each moved by 5 % at most."], sieve)


def ell():
    """One ball of the L alone cannot leave the closed pot. The open one has a mouth with room for a ball of
    radius 0.4; the L has to show it its long leg first."""
    body = [(0, 0, 0, 0.3), (0.5, 0, 0, 0.3), (1, 0, 0, 0.3), (0, 0.5, 0, 0.3)]
    write("space/ell.xyzr", ["An L of four balls."], body)
    pose_named("in_pot", (-0.5, -0.25, 0) + HOME[3:])
    pot = sphere(120, 2, 0.35)
    check_closed(2, HOME, pot, 0.3)
    write("space/pot_closed.xyzr", ["A shell with holes too small for a ball of the L."], pot)
    write("space/pot_open.xyzr", ["The same without its cap z > 1.86."], [b for b in pot if b[2] <= 0.93 * 2])


def bank():
    """A coin in a money box: a shell with a slot along x at its top, whose rims are rows of balls. One ball of the coin alone cannot
    pass the narrow slot; the coin as it lies passes the wide one straight up."""
    coin = [(0, 0, 0, 0.22)] + ring(6, 0.4, 0.22, 1)
    write("space/coin.xyzr", ["A thick coin: 1.24 across and 0.44 thick."], coin)
    for name, width in (("narrow", 0.2), ("wide", 0.8)):
        y, x = width / 2 + 0.3, 1.1
        box = sphere(160, 2, 0.3, keep=lambda a, b, c: c < 0 or abs(a) > x - 0.15 or abs(b) > y + 0.15)
        rims = []
        for a in range(-3, 4):
            for side in (-1, 1):
                rims.append((a * x / 3, side * y, math.sqrt(4 - y * y - (a * x / 3) ** 2), 0.3))
        box += rims + [(side * (x + 0.1), b, math.sqrt(4 - (x + 0.1) ** 2 - b * b), 0.3) for side in (-1, 1) for b in (-0.1, 0.1)]
        if name == "narrow":
            check_closed(2, HOME, box, 0.22)
        else:
            check_way([(0, 0, i / 10) + HOME[3:] for i in range(40)], coin, box, 0.1)
        write("space/bank_%s.xyzr" % name, ["A money box with a slot %g wide." % width], box)


# ---- space: two chambers and a tunnel -----------------------------------------------------------------------

def chambers():
    """Shells of radius 2 around (-3, 0, 0) and (3, 0, 0), and a tube along x. The tube begins with a ring of balls that lie on the
    shell, around its mouth. Narrow, every point of the shell and of its mouth is nearer to a centre than the radii of a ball
    there and a ball of the body together: no centre of the body's balls can cross it. Wide, the body passes in the
    middle."""
    r = 0.5
    body = bar((-0.5, 0, 0), (0.5, 0, 0), 0.5, 0.5)
    write("space/peanut.xyzr", ["Three balls in a row: 2 long, 1 thick."], body)
    pose_named("left_chamber", (-3, 0, 0) + about(2, 90))
    pose_named("right_chamber", (3, 0, 0) + about(1, 90))
    for name, inner in (("narrow", 0.4), ("wide", 0.8)):
        radius = inner + r
        mouth = math.sqrt(4 - radius * radius)
        balls = []
        for side in (-1, 1):
            balls += sphere(66, 2, r, (3 * side, 0, 0), lambda x, y, z: -side * x < mouth - 0.25)
        count = math.ceil(2 * math.pi * radius / 0.85)
        rings = math.ceil((6 - 2 * mouth) / 0.8)
        for i in range(rings + 1):
            balls += ring(count, radius, r, 0, (-3 + mouth + (6 - 2 * mouth) * i / rings, 0, 0), i * math.pi / count,
                          i * math.pi / count + 2 * math.pi)
        if name == "narrow":
            check_closed(2, (-3, 0, 0), balls, 0.5)
            check_closed(2, (3, 0, 0), balls, 0.5)
        else:
            check_way([(i / 10, 0, 0) + HOME[3:] for i in range(-30, 31)], body, balls, 0.25)
            for turn in range(0, 91, 5):
                check_way([(-3, 0, 0) + about(2, turn), (3, 0, 0) + about(1, turn)], body, balls, 0.25)
        write("space/chambers_%s.xyzr" % name, ["Two chambers, joined by a tunnel that has room for balls of radius %g." % inner],
              balls)


# ---- space: rings ----------------------------------------------------------------------------------------------

def rings():
    """Neighbouring balls overlap, so the circle through the centres stays inside the ring; two circles that are linked once stay
    linked."""
    write("space/ring.xyzr", ["A ring in the xy-plane."], ring(16, 1, 0.25, 2))
    write("space/link.xyzr", ["A ring in the xz-plane, around (1, 0, 0)."], ring(16, 1, 0.25, 1, (1, 0, 0)))
    pose_named("unlinked", (4, 0, 0) + HOME[3:])


def dumbbell():
    """No point of the hoop's disc is more than 0.7 from one of its centres, and 0.7 < 0.25 + 0.6: the centre of a large end cannot
    cross the disc, so one end stays on each side, with the bar between them. Small ends fit: 0.3 < 0.45."""
    for name, r in (("large", 0.6), ("small", 0.3)):
        write("space/dumbbell_%s.xyzr" % name, ["A dumbbell, its ends of radius %g." % r],
              [(-1, 0, 0, r), (1, 0, 0, r)] + bar((-1, 0, 0), (1, 0, 0), 0.2, 0.25)[1:-1])
    write("space/hoop.xyzr", ["A hoop with room for a ball of radius 0.45."], ring(16, 0.7, 0.25, 0))


def mug():
    """The handle runs around (1.1, 0, 0) in the xz-plane, and closes a circle with the cup. The eye is a circle that is linked with
    it; the hook is the lower part of that circle, and the mug comes off in a turn about its centre (or otherwise)."""
    cup = ring(8, 0.7, 0.3, 2, (0, 0, -0.25)) + ring(8, 0.7, 0.3, 2, (0, 0, 0.25)) + [(0, 0, -0.35, 0.45)]
    handle = ring(13, 0.6, 0.12, 1, (1.1, 0, 0), math.radians(-35), math.radians(215))
    write("space/mug.xyzr", ["A mug with a handle."], cup + handle)
    eye = ring(28, 0.9, 0.12, 0, (1.3, 0, 0.9))
    write("space/eye.xyzr", ["A ring through the handle."], eye)
    hook = (ring(18, 0.9, 0.12, 0, (1.3, 0, 0.9), math.radians(-190), math.radians(10)) +
            bar((1.3, 0.886, 1.2), (1.3, 0.886, 2.2), 0.12, 0.2))
    write("space/hook.xyzr", ["A hook through the handle, open at its tip."], hook)
    axis = (0, 0, 0.9)
    way = []
    for degrees in range(0, 121, 2):  # about the line along x through the hook's centre
        at = turned(about(0, -degrees), (0, 0, -0.9, 0))
        way.append(tuple(at[k] + axis[k] for k in range(3)) + about(0, -degrees))
    check_way(way, cup + handle, hook, 0.05)


# ---- space: a screw ----------------------------------------------------------------------------------------------

PITCH = 1.2


def screw():
    """A rod with a pin at its side, in a coil: the pin lies between two turns and reaches beyond them wherever the rod is, so
    that it turns as it goes."""
    body = bar((0, 0, -0.8), (0, 0, 0.8), 0.4, 0.35) + bar((0.5, 0, 0), (1.4, 0, 0), 0.12, 0.22)
    turns, each = 3, 20
    coil = [(math.cos(2 * math.pi * i / each), math.sin(2 * math.pi * i / each), PITCH * (i / each - turns / 2), 0.25)
            for i in range(turns * each + 1)]
    write("space/screw.xyzr", ["A rod along z with a pin at its side."], body)
    write("space/coil.xyzr", ["A coil around z, three turns of pitch %g, the pin between two." % PITCH], coil)
    check_way([(0, 0, PITCH * i / 360) + about(2, i) for i in range(0, 1200, 5)], body, coil, 0.2)


def space():
    os.makedirs(os.path.join(FOLDER, "space"), exist_ok=True)
    for scene in (shell, ell, bank, chambers, rings, dumbbell, mug, screw):
        scene()
    with open(os.path.join(FOLDER, "space/poses.txt"), "w") as out:
        out.write("# Named poses: name, then x,y,z,qw,qx,qy,qz.\n%-14s 0,0,0,1,0,0,0\n" % "home")
        out.write("\n".join(POSES) + "\n")


if __name__ == "__main__":
    hooked_t()
    grasp()
    key()
    space()
