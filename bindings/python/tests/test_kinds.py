"""What balls are of a solid stays with them: sets, parts, unions, solids, scenes, and answers."""

import copy
import pickle

import numpy as np
import pytest

from libcage import (
    Atlas,
    Balls,
    InputError,
    KindError,
    Pose,
    Poses,
    Scene,
    Solid,
    Verdict,
    from_wxyz,
    union,
)
from libcage.result import Result

DISC = [[0.0, 0.0, 0.04]]
FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])


@pytest.mark.parametrize("kind", ["inner", "outer", "exact", "unknown"])
def test_balls_of_balls_are_what_they_were(kind):
    balls = Balls(DISC, kind, "a.urdf")
    again = pickle.loads(pickle.dumps(balls))
    for same in (Balls(balls), Balls(balls, kind), copy.copy(balls), again):
        assert (same.kind, same.source) == (kind, "a.urdf")
        assert same.rows.tolist() == DISC
    other = "inner" if kind != "inner" else "exact"
    with pytest.raises(KindError, match="as_kind"):
        Balls(balls, other)
    assert balls.as_kind(other).kind == other


def test_outer_balls_wrapped_twice_prove_no_cage():
    scene = Scene(Balls(Balls(DISC, "outer")), FINGERS)
    assert scene.prove((0, 0, 0)).verdict is Verdict.UNDEFINED
    with pytest.raises(KindError):
        scene.prove((0, 0, 0), side="inner")


@pytest.mark.parametrize("kind", ["inner", "outer", "exact", "unknown"])
@pytest.mark.parametrize(
    "which", [slice(1, 3), np.array([False, True, True, False]), [1, 2], np.array([1, 2])]
)
def test_some_of_the_balls(kind, which):
    part = Balls(FINGERS, kind, "x")[which]
    assert part.rows.tolist() == FINGERS[1:3].tolist() and part.source == "x"
    assert part.kind == ("unknown" if kind == "outer" else kind)  # some of a cover need not cover


def test_all_balls_of_a_cover_cover_in_any_order():
    assert Balls(FINGERS, "outer")[[3, 1, 0, 2, 2]].kind == "outer"
    assert Balls(FINGERS, "outer")[::-1].kind == "outer"


@pytest.mark.parametrize(
    "which", [0, (slice(None), 0), None, "a", np.int64(1), np.eye(2, dtype=int)]
)
def test_what_is_no_set_of_balls_is_refused(which):
    with pytest.raises(TypeError):
        Balls(FINGERS)[which]


def test_arrays_of_balls_without_a_word_are_refused():
    """An array has no kind: numpy.vstack of outer balls would come back as exact."""
    balls = Balls(FINGERS, "outer")
    for make in (
        lambda: np.asarray(balls),
        lambda: np.vstack([balls, balls]),
        lambda: np.array(balls.rows) + balls,
        lambda: list(balls),
    ):
        with pytest.raises(TypeError):
            make()
    with pytest.raises(InputError):
        Scene(DISC, [balls, balls])


def test_the_kind_of_a_union_holds_for_all_of_it():
    kinds = {
        "inner": {"inner": "inner", "exact": "inner", "outer": "unknown", "unknown": "unknown"},
        "outer": {"outer": "outer", "exact": "outer", "inner": "unknown", "unknown": "unknown"},
        "exact": {"inner": "inner", "exact": "exact", "outer": "outer", "unknown": "unknown"},
        "unknown": dict.fromkeys(["inner", "outer", "exact", "unknown"], "unknown"),
    }
    for one, others in kinds.items():
        for other, wanted in others.items():
            both = Balls(DISC, one, "a") + Balls(FINGERS, other, "b")
            assert (both.kind, both.source, len(both)) == (wanted, "a, b", 5), (one, other)
    assert union([Balls(DISC), Balls(DISC, "inner"), Balls(DISC)]).kind == "inner"
    for bad in ([], [Balls(DISC), FINGERS], [Balls(DISC), Balls([[0, 0, 0, 1]])]):
        with pytest.raises(InputError):
            union(bad)
    with pytest.raises(TypeError):
        Balls(DISC) + FINGERS


@pytest.mark.parametrize("kind", ["outer", "unknown"])
def test_in_collision_is_not_proved_with_balls_that_prove_nothing_inside(kind):
    big = Balls([[0, 0, 0.06]], "outer")
    if kind == "outer":
        with pytest.raises(KindError):
            Solid(big, big)
        solid = Solid(None, big)
    else:
        solid = Solid(big.as_kind("unknown"), big)
    scene = Scene(solid, FINGERS)
    answer = scene.prove((0, 0, 0))
    assert answer.verdict is not Verdict.IN_COLLISION and "which are the solids" not in answer.about
    assert Verdict.IN_COLLISION not in scene.atlas(3).query([(0, 0, 0)])
    with pytest.raises(KindError):
        scene.collides([(0, 0, 0)])
    assert scene.collides([(0, 0, 0)], insist=True).tolist() == [True]
    answer = scene.prove((0, 0, 0), insist=True)
    assert answer.verdict is Verdict.IN_COLLISION and "not the solids" in answer.about


def test_solids_are_made_of_balls_in_their_places():
    inner, outer, exact = (Balls(DISC, kind) for kind in ("inner", "outer", "exact"))
    for bad in ((outer, None), (None, inner), (outer, inner), (exact, inner), (outer, exact)):
        with pytest.raises(KindError):
            Solid(*bad)
    with pytest.raises(KindError):
        Solid(exact, Balls([[0, 0, 0.05]], "exact"))  # both cannot be the solid
    with pytest.raises(InputError):
        Solid(np.array(DISC), None)
    assert Scene(Solid(inner, outer), FINGERS).prove((0, 0, 0)).verdict is Verdict.CAGED
    assert Solid(exact, Balls(DISC, "exact")).is_exact()


def test_the_answer_is_about_the_balls_only_where_they_are_the_solid():
    words = "the balls, which are the solids"
    assert Scene(DISC, FINGERS).prove((0, 0, 0)).about == words
    inner = Balls(DISC, "inner")
    for solid in (inner, Solid(inner, None), Solid(Balls(DISC, "unknown"), Balls(DISC, "outer"))):
        about = Scene(solid, FINGERS).prove((0, 0, 0), max_cells=10).about
        assert about != words and "by their balls" in about


def test_immutable_is_immutable():
    scene = Scene(DISC, FINGERS)
    balls, atlas, grid = scene.obstacles.inner, scene.atlas(2), scene.grid()
    for one, name in (
        (scene, "obstacles"),
        (scene, "object"),
        (scene, "unit"),
        (scene, "anything"),
        (balls, "kind"),
        (balls, "rows"),
        (balls, "source"),
        (atlas, "insisted"),
        (atlas, "unit"),
        (grid, "unit"),
        (scene.object, "inner"),
        (Pose((0, 0), (1, 0, 0, 0)), "x"),
    ):
        with pytest.raises(AttributeError):
            setattr(one, name, None)
        with pytest.raises(AttributeError):
            delattr(one, name)
    answer = Scene(DISC, FINGERS[:2]).prove((0, 0, 0))
    poses = Poses(np.zeros((1, 2)), np.array([[1.0, 0, 0, 0]]))
    for array in (
        balls.rows,
        balls.centres,
        balls.radii,
        grid.arrays[2],
        poses.x,
        poses.wxyz,
        answer.path.grid,
        Result.from_bytes(answer.to_bytes()).path.grid,
    ):
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.setflags(write=True)
    assert scene.prove((0, 0, 0)).verdict is Verdict.CAGED
    again = pickle.loads(pickle.dumps(scene))
    assert again.prove((0, 0, 0)).to_bytes() == scene.prove((0, 0, 0)).to_bytes()
    assert copy.deepcopy(scene).object.is_exact()


def test_poses_do_not_see_their_arrays_change():
    x, q = np.zeros((1, 2)), np.array([[1.0, 0, 0, 0]])
    poses = Poses(x, q)
    x[:], q[:] = 9, 9
    assert poses.x.tolist() == [[0, 0]] and poses.wxyz.tolist() == [[1, 0, 0, 0]]


NAN = float("nan")


@pytest.mark.parametrize(
    "x,q",
    [
        ((0, 0), (NAN, 0, 0, 1)),
        ((0, 0), (1, 0, 0, NAN)),
        ((0, 0), (4, 0, 0, 1)),
        ((0, 0), (2, 0, 0, 0)),
        ((0, 0), (0, 0, 0, 0)),
        ((0, 0), (1e-9, 0, 0, 1.3e-9)),
        ((0, 0), (np.inf, 0, 0, 1)),
        ((0, 0), (0.6, 0.8, 0, 0)),
        ((0, 0), (1, 0, 0)),
        ((0,), (1, 0, 0, 0)),
        ((0, 0, 0, 0), (1, 0, 0, 0)),
        ((NAN, 0), (1, 0, 0, 0)),
        ((np.inf, 0), (1, 0, 0, 0)),
        ((0, 0, 0), (1e300, 0, 0, 1e300)),
        ((0, 0, 0), (1e-320, 0, 0, 1e-320)),
        ((0, 0, 0), (0, 0, 0, 0)),
    ],
)
def test_poses_that_are_none_are_refused_when_they_are_made(x, q):
    with pytest.raises(InputError):
        Pose(x, q)
    with pytest.raises(InputError):
        Poses(np.array([x], dtype=float), np.array([q], dtype=float))


def test_poses_have_one_rotation_each():
    for x, q in (
        (np.zeros((3, 2)), np.array([[1.0, 0, 0, 0]])),
        (np.zeros((1, 2)), np.tile([1.0, 0, 0, 0], (3, 1))),
        (np.zeros(2), np.array([1.0, 0, 0, 0])),
        (np.zeros((1, 2)), np.array([["1", "0", "0", "0"]])),
    ):
        with pytest.raises(InputError):
            Poses(x, q)
    q = np.array([0.6, 0, 0, 0.8]) * 1.0009
    assert np.allclose(Pose((0, 0), q).wxyz, (0.6, 0, 0, 0.8), atol=1e-15, rtol=0)
    assert np.allclose(Poses(np.zeros((1, 2)), q[None]).wxyz, (0.6, 0, 0, 0.8), atol=1e-15, rtol=0)


def test_what_a_mask_hides_is_not_read():
    hidden = [[False] * 3, [True] * 3]
    with pytest.raises(InputError, match="masked"):
        Balls(np.ma.array(np.vstack([DISC, [[0, 0, 9e9]]]), mask=hidden))
    with pytest.raises(InputError, match="masked"):
        Balls([np.ma.array([0, 0, 1.0], mask=[0, 0, 1])])
    scene = Scene(DISC, FINGERS)
    for bad in (np.ma.array([[0, 0, 0.0]], mask=True), [np.ma.array([0, 0, 0.0], mask=True)]):
        for ask in (scene.collides, scene.atlas(2).query):
            with pytest.raises(InputError, match="masked"):
                ask(bad)
    with pytest.raises(InputError, match="masked"):
        scene.prove(np.ma.array([0, 0, 0.0], mask=True))
    with pytest.raises(InputError, match="masked"):
        from_wxyz(np.ma.array([0, 0, 0.0], mask=True), [1, 0, 0, 0])


def test_an_atlas_says_which_poses_it_answered_about():
    atlas = Scene(DISC, FINGERS, unit=2.0**-10).atlas(3)
    asked = [(0.0004, 0, 0.1), (0.0006, -0.0006, 0)]
    told = atlas.rounded(asked)
    assert told.x.tolist() == [[0, 0], [2.0**-10, -(2.0**-10)]]
    assert np.allclose(told.theta, [0.1, 0], atol=1e-8)
    assert atlas.query(told).tolist() == atlas.query(asked).tolist()
    assert atlas.rounded(told).x.tolist() == told.x.tolist()


@pytest.mark.parametrize("bad", ["abc", None, 5, [1, 2], b""])
def test_what_is_no_atlas_is_refused(bad):
    from libcage import AtlasError

    with pytest.raises(AtlasError):
        Atlas(bad)
