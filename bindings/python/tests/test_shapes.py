"""Balls for meshes and polygons: every inner one is inside, every bad one is refused, covers cover.

The referee is apart from what it checks: distances in Fractions by another formula, insideness by
the solid angle or by shapely, and points of the solid drawn at random for the covers."""

from fractions import Fraction

import numpy as np
import pytest
import shapely
import trimesh
from shapely.geometry import MultiPolygon, Point, Polygon, box

import libcage
from libcage import Balls, Scene, SolidError, Verdict, fit, verify_balls, verify_cover
from libcage.shapes import exact
from libcage.shapes.solids import boundary


def turned(mesh, seed):
    """A mesh at a pose of no roundness."""
    matrix = trimesh.transformations.random_rotation_matrix(
        np.random.default_rng(seed).uniform(size=3)
    )
    mesh.apply_transform(matrix)
    return mesh


def bracket():
    return trimesh.creation.extrude_polygon(
        Polygon([(0, 0), (0.06, 0), (0.06, 0.01), (0.01, 0.01), (0.01, 0.05), (0, 0.05)]), 0.03
    )


def lens():
    profile = np.array([[0, -0.01], [0.02, -0.004], [0.025, 0], [0.02, 0.004], [0, 0.01]])
    return trimesh.creation.revolve(profile, sections=24)


def bumpy():
    mesh = trimesh.creation.icosphere(3, 0.04)
    mesh.vertices *= 1 + 0.15 * np.sin(9 * mesh.vertices[:, :1] / 0.04) * np.cos(
        7 * mesh.vertices[:, 1:2] / 0.04
    )
    return mesh


def two_boxes():
    other = trimesh.creation.box((0.02, 0.08, 0.02))
    other.apply_translation([0.01, 0, 0.003])
    return trimesh.util.concatenate([trimesh.creation.box((0.06, 0.02, 0.02)), other])


SOLIDS = {
    "bracket": lambda: turned(bracket(), 1),
    "torus": lambda: turned(trimesh.creation.torus(0.03, 0.008, 24, 10), 2),
    "lens": lambda: turned(lens(), 3),
    "bumpy": bumpy,
    "two boxes that overlap": two_boxes,
    "thin plate": lambda: turned(trimesh.creation.box((0.1, 0.08, 0.001)), 4),
    "ell": lambda: Polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]),
    "two holes": lambda: (
        Point(0, 0)
        .buffer(2)
        .difference(Point(0.9, 0.1).buffer(0.6))
        .difference(Point(-0.9, 0).buffer(0.5))
    ),
    "two parts": lambda: MultiPolygon([box(0, 0, 1, 1 / 3), Point(3, 0.1).buffer(0.7)]),
    "gear": lambda: Polygon(
        [
            (
                (1 + 0.2 * (k % 4 < 2)) * np.cos(k * np.pi / 24),
                (1 + 0.2 * (k % 4 < 2)) * np.sin(k * np.pi / 24),
            )
            for k in range(48)
        ]
    ),
}


def segment_distance2(p, a, b):
    """The square of the distance of a point from a segment, in Fractions."""
    d = [y - x for x, y in zip(a, b)]
    length = sum(x * x for x in d)
    t = Fraction(0)
    if length:
        t = max(
            Fraction(0), min(Fraction(1), sum((y - x) * z for x, y, z in zip(a, p, d)) / length)
        )
    return sum((x + t * z - y) ** 2 for x, y, z in zip(a, p, d))


def triangle_distance2(p, a, b, c):
    """The same from a triangle: the least over its inside, by solving for it, and its edges."""
    best = min(segment_distance2(p, *edge) for edge in ((a, b), (b, c), (c, a)))
    u, v, w = ([y - x for x, y in zip(a, q)] for q in (b, c, p))
    uu, uv, vv = (sum(x * y for x, y in zip(f, g)) for f, g in ((u, u), (u, v), (v, v)))
    uw, vw = (sum(x * y for x, y in zip(f, w)) for f in (u, v))
    det = uu * vv - uv * uv
    if det:
        s, t = (uw * vv - vw * uv) / det, (vw * uu - uw * uv) / det
        if s >= 0 and t >= 0 and s + t <= 1:
            best = min(best, sum((x * s + y * t - z) ** 2 for x, y, z in zip(u, v, w)))
    return best


def fractions(point):
    return [Fraction(float(x)) for x in point]


def distance2(solid, point):
    """Exact, to all elements that are not obviously farther."""
    corners = boundary(solid).corners
    p = fractions(point)
    rough = np.linalg.norm(corners - point, axis=2).min(axis=1)
    size = np.linalg.norm(corners.max(axis=1) - corners.min(axis=1), axis=1)
    near = np.flatnonzero(rough - size <= rough.min() * 1.001)
    function = segment_distance2 if corners.shape[2] == 2 else triangle_distance2
    return min(function(p, *(fractions(corner) for corner in corners[i])) for i in near)


def turns(solid, point):
    """How often the mesh goes around the point: its solid angle in doubles; of a polygon 1
    inside."""
    if isinstance(solid, trimesh.Trimesh):
        a, b, c = (solid.vertices[solid.faces[:, k]] - point for k in range(3))
        la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        top = np.einsum("ij,ij->i", a, np.cross(b, c))
        below = la * lb * lc + (a * b).sum(1) * lc + (b * c).sum(1) * la + (c * a).sum(1) * lb
        return round(float(np.arctan2(top, below).sum() / (2 * np.pi)))
    return int(shapely.contains_xy(solid, *point))


@pytest.fixture(scope="module")
def fits():
    return {
        name: (solid, fit(solid, count=30, samples=500, outer_tolerance=boundary(solid).size / 12))
        for name, solid in ((name, make()) for name, make in SOLIDS.items())
    }


@pytest.mark.parametrize("name", SOLIDS)
def test_every_inner_ball_is_inside(fits, name):
    solid, made = fits[name]
    assert len(made.inner) >= 2 and made.filled > 0.2
    assert made.inner.kind == "inner" and made.outer.kind == "outer"
    assert verify_balls(solid, made.inner).ok.all()
    for row in made.inner.rows:
        assert Fraction(float(row[-1])) ** 2 <= distance2(solid, row[:-1])
        assert turns(solid, row[:-1]) == 1


@pytest.mark.parametrize("name", SOLIDS)
def test_the_outer_balls_cover_it_and_stay_near(fits, name):
    solid, made = fits[name]
    assert verify_cover(solid, made.outer, leaf=0.25 * made.outer_tolerance)
    rng = np.random.default_rng(0)
    edge = boundary(solid)
    points = rng.uniform(edge.low.min(axis=0), edge.high.max(axis=0), (1500, edge.dim))
    points = np.array([point for point in points if turns(solid, point)])
    t = rng.dirichlet(np.ones(edge.corners.shape[1]), len(edge.corners))
    points = np.concatenate([points, np.einsum("nv,nvc->nc", t, edge.corners)])
    gap = (
        np.linalg.norm(points[:, None] - made.outer.centres[None], axis=2) - made.outer.radii[None]
    )
    assert gap.min(axis=1).max() <= 1e-12
    for row in made.outer.rows[
        :: max(1, len(made.outer) // 20)
    ]:  # within the tolerance, as far as points tell
        depth = np.sqrt(float(distance2(solid, row[:-1]))) * (-1 if turns(solid, row[:-1]) else 1)
        assert depth + row[-1] <= made.outer_tolerance * (1 + 1e-6)
    if len(made.outer) > 3:
        assert not verify_cover(solid, made.outer.rows[:1])


def largest(solid, centre):
    """The largest double that is no larger than the distance."""
    exact2 = distance2(solid, np.asarray(centre))
    r = float(np.sqrt(float(exact2)))
    while Fraction(r) ** 2 > exact2:
        r = np.nextafter(r, 0)
    while Fraction(float(np.nextafter(r, 9))) ** 2 <= exact2:
        r = float(np.nextafter(r, 9))
    return r


def bad_balls():
    """32 balls that are not inside, and why, each with a solid."""
    rng = np.random.default_rng(7)
    plate = trimesh.creation.box((0.1, 0.08, 0.001))
    ell = SOLIDS["ell"]()
    holes = SOLIDS["two holes"]()
    torus = trimesh.creation.torus(0.03, 0.008, 24, 10)
    made = []
    for solid, low, high in (
        (torus, [0.027, -0.003, -0.003], [0.033, 0.003, 0.003]),
        (plate, [-0.04, -0.03, -0.0003], [0.04, 0.03, 0.0003]),
        (ell, [0.2, 0.2], [0.8, 0.8]),
        (holes, [-0.2, 0.8], [0.2, 1.4]),
    ):
        for _ in range(5):  # 20: too large by one ulp
            centre = rng.uniform(low, high)
            made.append((solid, [*centre, np.nextafter(largest(solid, centre), 9)]))
    made += [
        (plate, [0, 0, 0.0006, 1e-5]),
        (plate, [0, 0, 0.0005, 1e-9]),  # beside a thin plate, on its face
        (torus, [0, 0, 0, 0.01]),
        (torus, [0, 0, 0, 1e-6]),  # in the hole
        (holes, [0.9, 0.1, 0.1]),
        (holes, [0.9, 0.1, 0.9]),  # in a hole, around it
        (ell, [2, 1.5, 0.1]),
        (ell, [1, 1, 0.2]),  # in the notch, at its corner
        (plate, [0, 0, 0, 0]),
        (torus, [0.03, 0, 0, -0.001]),  # no radius
        (ell, [0.5, 0.5, np.nan]),
        (torus, [np.inf, 0, 0, 0.001]),
    ]
    return made


@pytest.mark.parametrize("index", range(32))
def test_bad_balls_are_refused(index):
    solid, row = bad_balls()[index]
    check = verify_balls(solid, [row])
    assert not check and check.problems[0]
    with pytest.raises((SolidError, libcage.InputError)):
        libcage.shapes.inner_of(solid, [row])
    if index < 20:  # and one ulp smaller it is right
        row[-1] = np.nextafter(row[-1], 0)
        assert verify_balls(solid, [row])


def test_there_are_32():
    assert len(bad_balls()) == 32


def broken(change):
    mesh = trimesh.creation.box((2, 2, 2))
    faces, vertices = np.array(mesh.faces), np.array(mesh.vertices)
    change(vertices, faces)
    return trimesh.Trimesh(vertices, faces, process=False)


@pytest.mark.parametrize(
    "solid",
    [
        broken(lambda v, f: f.__setitem__(0, f[0][::-1])),  # a face turned over
        broken(lambda v, f: f.__setitem__(slice(None), f[:, ::-1].copy())),  # inside out
        broken(lambda v, f: f.__setitem__(0, f[1])),  # a hole
        broken(lambda v, f: v.__setitem__((0, 0), np.nan)),
        broken(lambda v, f: v.__setitem__((0, 0), np.inf)),
        broken(lambda v, f: v.__setitem__((slice(None), 2), 0)),  # flat
        trimesh.Trimesh(np.zeros((0, 3)), np.zeros((0, 3), int), process=False),
        Polygon(),
        Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]),
        shapely.LineString([(0, 0), (1, 1)]),
        Polygon([(0, 0), (4, 0), (4, 4), (0, 4)], [[(1, 1), (5, 1), (5, 2), (1, 2)]]),
        "a string",
        7,
    ],
)
def test_what_bounds_no_solid_is_refused(solid):
    with pytest.raises(SolidError):
        fit(solid)
    with pytest.raises(SolidError):
        verify_balls(solid, [[0.1, 0.1, 0.1, 0.01]])


def test_polygon_of_nan():
    with pytest.raises(SolidError):
        verify_balls(Polygon([(0, 0), (1, 0), (np.nan, 1)]), [[0.5, 0.2, 0.01]])


def test_faces_without_area_are_walls_too():
    """A box with a needle of no area that sticks out of a face's middle inwards: balls stop at
    it."""
    mesh = trimesh.creation.box((2, 2, 2))
    v = np.vstack([mesh.vertices, [[1, 0, 0], [0.2, 0, 0], [0.6, 0, 0]]])
    needle = trimesh.Trimesh(v, np.vstack([mesh.faces, [[8, 9, 10], [10, 9, 8]]]), process=False)
    assert verify_balls(mesh, [[0, 0, 0, 1]])
    assert not verify_balls(needle, [[0, 0, 0, 1]])
    assert verify_balls(needle, [[0, 0, 0, 0.2]]) and not verify_balls(needle, [[0, 0, 0, 0.2001]])


def test_where_a_mesh_overlaps_itself_only_the_sure_part_counts():
    solid = two_boxes()
    assert verify_balls(solid, [[-0.02, 0, 0, 0.009]])  # in one box
    assert not verify_balls(
        solid, [[0.01, 0, 0.001, 0.005]]
    )  # in both: even-odd and nonzero disagree
    inner = trimesh.creation.box((1, 1, 1))
    outer = trimesh.creation.box((3, 3, 3))
    inner.invert()
    hollow = trimesh.util.concatenate([outer, inner])
    assert not verify_balls(hollow, [[0, 0, 0, 0.4]]) and verify_balls(hollow, [[1, 0, 0, 0.49]])
    assert not verify_balls(hollow, [[0, 0, 0, 1.4]])
    made = fit(hollow, count=30, outer_tolerance=0.3)
    gap = np.linalg.norm(made.outer.centres, axis=1) - made.outer.radii
    assert gap.min() > 0.1  # the cover leaves the cavity open


def test_rings_that_touch():
    """A hole that touches the shell in a point, and one that touches another hole: valid, and
    right."""
    solid = Polygon(
        [(0, 0), (6, 0), (6, 4), (0, 4)],
        [[(0, 2), (1, 1), (2, 2), (1, 3)], [(2, 2), (3, 1), (4, 2), (3, 3)]],
    )
    assert solid.is_valid
    assert verify_balls(solid, [[1, 0.4, 0.39], [5, 2, 0.9], [2, 0.75, 0.5]]).ok.tolist() == [
        True,
        True,
        True,
    ]
    assert (
        verify_balls(solid, [[1, 2, 0.1], [3, 2, 0.1], [2, 2, 0.1], [0, 2, 0.1]]).ok.tolist()
        == [False] * 4
    )
    made = fit(solid, count=30)
    assert verify_cover(solid, made.outer)


@pytest.mark.parametrize("seed", range(4))
def test_exact_predicates_agree_with_fractions(seed):
    """Small integers, so that equality, points on edges' lines and flat triangles all happen."""
    rng = np.random.default_rng(seed)
    for _ in range(400):
        p, a, b, c = rng.integers(-3, 4, (4, 3)).tolist()
        wanted = triangle_distance2(*(list(map(Fraction, q)) for q in (p, a, b, c)))
        for r2 in range(0, 20):
            assert exact.triangle_clear(p, a, b, c, r2) == (wanted >= r2)
        wanted = segment_distance2(*(list(map(Fraction, q[:2])) for q in (p, a, b)))
        for r2 in range(0, 20):
            assert exact.segment_clear(p[:2], a[:2], b[:2], r2) == (wanted >= r2)


def test_winding_numbers_where_the_ray_meets_edges_and_corners():
    """Integer points around a mesh with integer corners: rays along x hit edges and corners all the
    time."""
    octahedron = trimesh.convex.convex_hull(np.vstack([np.eye(3), -np.eye(3)]) * 2)
    mesh = trimesh.util.concatenate([trimesh.creation.box((4, 4, 4)), octahedron])
    edge = boundary(mesh)
    seen = set()
    for x in range(-4, 5):
        for y in range(-4, 5):
            for z in range(-4, 5):
                p = np.array([x, y, z], dtype=float)
                if edge.clear(np.append(p, 1e-9)):
                    wanted = int(max(abs(p)) < 2) + int(abs(p).sum() < 2)
                    assert edge.windings(p).get(0, 0) == wanted
                    seen.add(wanted)
    assert seen == {0, 1, 2}


def test_scale_and_place_do_not_matter():
    for scale, shift in ((1e-6, 0), (1e9, 0), (1, 1e6)):
        mesh = trimesh.creation.box((2 * scale, scale, scale))
        mesh.apply_translation([shift, 0, 0])
        made = fit(mesh, count=8, samples=200, outer_tolerance=0.3 * scale)
        assert verify_balls(mesh, made.inner) and len(made.inner) == 8


def test_shapes_in_scenes():
    """A square peg of polygons between four walls of polygons: caged; without a wall: free."""
    peg = box(-0.01, -0.01, 0.01, 0.01)
    walls = [
        box(-0.02, 0.0125, 0.02, 0.016),
        box(-0.02, -0.016, 0.02, -0.0125),
        box(0.0125, -0.016, 0.016, 0.016),
        box(-0.016, -0.016, -0.0125, 0.016),
    ]
    part = fit(peg, count=60, outer_tolerance=0.0005)
    for count, verdict in ((4, Verdict.CAGED), (3, Verdict.FREE)):
        frame = shapely.union_all(walls[:count])
        frame = frame if frame.geom_type == "MultiPolygon" else MultiPolygon([frame])
        scene = Scene(part, fit(frame, count=300, outer_tolerance=0.0008, samples=4000))
        assert scene.prove((0, 0, 0)).verdict is verdict


def test_balls_from_elsewhere_become_inner_ones_only_after_a_check():
    mesh = trimesh.creation.icosphere(3, 1.0)
    assert libcage.shapes.inner_of(mesh, [[0, 0, 0, 0.9]]).kind == "inner"
    with pytest.raises(SolidError):  # the ball that the mesh is meant to be pokes out of it
        libcage.shapes.inner_of(mesh, Balls([[0, 0, 0, 1.0]]))
