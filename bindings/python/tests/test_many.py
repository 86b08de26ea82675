"""prove_many: the same bytes on every executor, with workers that die, checkpoints that lie."""

import os
import signal
import time
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager

import numpy as np
import pytest

from libcage import Balls, InputError, KindError, Question, Scene, many, prove_many


def questions(count=24):
    made = []
    for k in range(count):
        rng = np.random.default_rng(k)
        t = np.sort(rng.uniform(0, 2 * np.pi, 6))
        walls = np.c_[0.09 * np.cos(t), 0.09 * np.sin(t), rng.uniform(0.02, 0.05, 6)]
        part = [[0, 0, 0.03], [0.04, 0, 0.01], [-0.03, 0.02, 0.01]]
        made.append(
            Question(
                Scene(part, walls),
                (0, 0, float(k)),
                (0.4, 0, 0) if k % 3 == 0 else None,
                {"max_cells": 2000},
            )
        )
    return made


@pytest.fixture(scope="module")
def wanted():
    results = prove_many(questions())
    assert len({result.verdict for result in results}) >= 3
    return [result.to_bytes() for result in results]


def bytes_of(results):
    return [result.to_bytes() for result in results]


def test_a_process_pool_gives_the_same_bytes(wanted):
    with ProcessPoolExecutor(2) as pool:
        assert bytes_of(prove_many(questions(), pool, progress=True)) == wanted
    with ThreadPoolExecutor(3) as pool:
        assert bytes_of(prove_many(questions(), pool)) == wanted


class Dying(ThreadPoolExecutor):
    """Every third job dies with its worker, the first time."""

    def __init__(self):
        super().__init__(2)
        self.count = 0

    def submit(self, function, /, *arguments):
        self.count += 1
        if self.count % 3 == 0:
            future = Future()
            future.set_exception(BrokenProcessPool("a worker died"))
            return future
        return super().submit(function, *arguments)


def test_jobs_whose_worker_died_are_asked_again(wanted):
    with Dying() as pool:
        assert bytes_of(prove_many(questions(), pool)) == wanted
        assert pool.count > len(wanted)
    with Dying() as pool, pytest.raises(BrokenProcessPool):
        prove_many(questions(), pool, retries=0)


def test_a_pool_whose_process_is_killed_is_made_anew(wanted, tmp_path):
    pools = []

    def make():
        pools.append(ProcessPoolExecutor(2))
        if len(pools) == 1:
            pid = pools[0].submit(os.getpid).result()
            pools[0].submit(time.sleep, 0.05)
            pools[0].submit(os.kill, pid, signal.SIGKILL)
            pools[0].submit(os._exit, 1)
        return pools[-1]

    assert bytes_of(prove_many(questions(), make, retries=5, checkpoint=tmp_path)) == wanted
    assert len(pools) > 1


def test_checkpoints(wanted, tmp_path, monkeypatch):
    assert bytes_of(prove_many(questions(8), checkpoint=tmp_path)) == wanted[:8]
    assert len(list(tmp_path.glob("*.json"))) == 8 and not list(tmp_path.glob("*.part"))
    asked = []
    real = many.answer
    monkeypatch.setattr(many, "answer", lambda question: asked.append(1) or real(question))
    assert bytes_of(prove_many(questions(), checkpoint=tmp_path)) == wanted
    assert len(asked) == len(wanted) - 8
    assert bytes_of(prove_many(questions(), checkpoint=tmp_path)) == wanted
    assert len(asked) == len(wanted) - 8


def test_checkpoints_that_were_changed_or_belong_to_another_question_are_not_believed(
    tmp_path, monkeypatch
):
    free = Question(Scene([[0, 0, 0.04]], [[0.07, 0, 0.02]]), (0, 0, 0))
    caged = Question(
        Scene(
            [[0, 0, 0.04]], [[0.07 * np.cos(t), 0.07 * np.sin(t), 0.02] for t in (0, 1.6, 3.1, 4.7)]
        ),
        (0, 0, 0),
    )
    assert [str(r.verdict) for r in prove_many([free, caged], checkpoint=tmp_path)] == [
        "FREE",
        "CAGED",
    ]
    file = tmp_path / f"{free.key()}.json"
    good = file.read_text()
    for bad in (
        good.replace("FREE", "CAGED"),
        good[:100],
        "",
        "[]",
        "{}",
        (tmp_path / f"{caged.key()}.json").read_text(),
    ):
        file.write_text(bad)
        assert str(prove_many([free], checkpoint=tmp_path)[0].verdict) == "FREE"
    before = free.key()
    monkeypatch.setattr(many, "library_hash", lambda: b"another library")
    assert free.key() != before  # an answer of another library is not found


def test_everything_that_an_answer_depends_on_is_in_the_key():
    disc, walls = [[0, 0, 0.04]], [[0.07, 0, 0.02], [-0.07, 0, 0.02]]
    base = Scene(disc, walls)
    same = [Question(base, (0, 0, 0)), Question(Scene(np.array(disc), walls), [0.0, 0, 0])]
    other = [
        Question(base, (0, 0, 0.1)),
        Question(base, (0, 0, 0), (0, 0, 0)),
        Question(Scene(walls, disc), (0, 0, 0)),
        Question(base, (0, 0, 0), options={"side": "inner"}),
        Question(base, (0, 0, 0), options={"max_cells": 9}),
        Question(Scene(Balls(disc, "inner"), walls), (0, 0, 0)),
        Question(Scene(Balls(disc, "outer"), walls), (0, 0, 0), options={"insist": True}),
        Question(Scene(disc, walls, unit=2.0**-20), (0, 0, 0)),
        Question(Scene(disc, walls[:1]), (0, 0, 0)),
    ]
    assert len({one.key() for one in same}) == 1
    assert len({one.key() for one in same + other}) == 1 + len(other)


def test_what_the_library_refuses_is_raised_at_once(tmp_path):
    bad = Question(Scene([[0, 0, 1]], Balls([[3, 0, 1]], "unknown")), (0, 0, 0))
    with ProcessPoolExecutor(1) as pool, pytest.raises(KindError):
        prove_many([bad], pool)
    with pytest.raises(InputError):
        prove_many([1])
    with pytest.raises(InputError):
        Question(bad.scene, (0, 0, 0), options={"threads": 3})


@contextmanager
def two_workers():
    """A Dask client of two processes."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            memory_limit=0,
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def test_dask_with_a_worker_that_is_killed_gives_the_same_bytes(wanted):
    with two_workers() as client:
        pids = client.run(os.getpid)
        assert len(set(pids.values())) == 2
        killed = []

        executor = client.get_executor(pure=False)
        submit = executor.submit
        count = [0]

        def counting(function, *arguments, **options):
            count[0] += 1
            future = submit(function, *arguments, **options)
            if count[0] == 12:
                killed.append(next(iter(pids.values())))
                os.kill(killed[0], signal.SIGKILL)
            return future

        executor.submit = counting
        assert bytes_of(prove_many(questions(), executor)) == wanted
        assert killed
        executor.shutdown(wait=False)


def test_an_atlas_in_parts_has_the_same_bytes(tmp_path):
    scene = Scene([[0, 0, 0.03], [0.05, 0, 0.02]], [[0.1, 0, 0.05], [-0.1, 0.02, 0.06]])
    for options in ({"level": 5}, {"level": 2, "budget": 60}, {"level": 4, "side": "inner"}):
        whole = scene.atlas(**options).to_bytes()
        with ProcessPoolExecutor(2) as pool:
            assert scene.atlas(executor=pool, parts=5, **options).to_bytes() == whole
        with Dying() as pool:
            assert scene.atlas(executor=pool, parts=7, **options).to_bytes() == whole
            assert pool.count > 7
        folder = tmp_path / str(options["level"])
        with ThreadPoolExecutor(2) as pool:
            scene.atlas(executor=pool, parts=6, checkpoint=folder, **options)
        kept = sorted(folder.iterdir())
        assert len(kept) == 6
        kept[0].unlink()
        kept[1].write_text(kept[1].read_text()[:-9])  # cut off: not believed
        with Dying() as pool:
            got = scene.atlas(executor=pool, parts=6, checkpoint=folder, **options)
        assert got.to_bytes() == whole
    with ThreadPoolExecutor(1) as pool, pytest.raises(InputError):
        scene.atlas(4, executor=pool, parts=0)


def test_an_atlas_on_dask_with_a_worker_killed_has_the_same_bytes():
    scene = Scene([[0, 0, 0.03], [0.05, 0, 0.02]], [[0.1, 0, 0.05], [-0.1, 0.02, 0.06]])
    whole = scene.atlas(7).to_bytes()
    with two_workers() as client:
        executor = client.get_executor(pure=False)
        submit, count = executor.submit, [0]

        def killing(function, *arguments, **options):
            count[0] += 1
            future = submit(function, *arguments, **options)
            if count[0] == 6:
                os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)
            return future

        executor.submit = killing
        assert scene.atlas(7, executor=executor, parts=12).to_bytes() == whole
        assert count[0] >= 12
