"""Trials on a real scheduler of Dask with workers in other processes, some of which are ended while they work."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial
from pathlib import Path

import pytest

import skillc
from learning.runners import Wiping, aim, open_study
from skillc.errors import ServiceError
from skillc.services.learning.search import Search
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.trials.executors import choose_executor
from skillc_runtime.evaluation.trials.dispatch import ExecutorError, run_on
from trials.clusters import Cluster
from trials.runners import KILLED, Faulty, Noted, good
from trials.test_executors import alive
from waiting import LONG_S, wait_until

pytest.importorskip("distributed", reason="Dask is not installed: pip install 'skillc[cluster]'")
pytestmark = pytest.mark.slow

WORKERS = 4
CLIENT = """
import sys
from functools import partial
from pathlib import Path
from distributed import Client
from skillc_runtime.evaluation.trials.dispatch import run_on
from trials.runners import Noted

if __name__ == "__main__":
    with Client(sys.argv[1]) as client:
        for tried in run_on(client.get_executor(), partial(Noted, Path(sys.argv[2]), 600.0), range(20, 40)):
            pass
"""
OTHER_VERSION = """
from skillc_runtime.evaluation.trials import hosting
hosting.identify_skillc = lambda: "0.0 of 12, MuJoCo 3"
"""


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    made = Cluster(tmp_path_factory.mktemp("cluster"))
    try:
        wait_until(lambda: made.is_up)
        for _ in range(WORKERS):
            made.start_worker()
        with made.connected() as client:
            client.wait_for_workers(WORKERS, timeout=LONG_S)
        yield made
    finally:
        made.end()


@pytest.fixture
def noted(tmp_path: Path) -> Path:
    (folder := tmp_path / "noted").mkdir()
    return folder


def read_notes(folder: Path) -> list[tuple[int, int, int]]:
    """Return the seed, the process and the worker of each trial that has begun."""
    return [(int(seed), int(pid), int(host)) for seed, pid, host in (each.name.split("-") for each in folder.iterdir())]


def test_the_command_has_the_same_trials_from_workers_as_from_processes_here(cluster: Cluster) -> None:
    words = ("trials", "contact:press_button", "-n", "2", "--json", "--scheduler", cluster.address)
    command = (sys.executable, "-m", "skillc", *words)
    there = subprocess.run(command, env=cluster.environment, capture_output=True, text=True, check=False)
    assert (there.returncode, there.stderr) == (0, "")
    with ThreadPoolExecutor(2) as executor:
        here = json.loads(json.dumps(skillc.trials("contact:press_button", 2, executor=executor).to_dict()))
    found = json.loads(there.stdout)
    assert json.dumps(found["trials"]) == json.dumps(here["trials"]) and found["passed"] == 2
    assert {**found, "mean_wall_time_s": 0} == {**here, "mean_wall_time_s": 0}


def test_a_worker_with_several_threads_is_refused(cluster: Cluster) -> None:
    worker = cluster.start_worker("--nthreads", "2")
    try:
        with cluster.connected() as client:
            client.wait_for_workers(WORKERS + 1, timeout=LONG_S)
            refused = pytest.raises(
                ServiceError, match=r"the worker tls://.* has 2 threads; start it with --nthreads 1"
            )
            with refused, choose_executor(None, cluster.address, 3, SilentReporter())():
                pass
    finally:
        end(worker, cluster)


def test_a_worker_with_another_version_is_refused(cluster: Cluster, tmp_path: Path) -> None:
    (preload := tmp_path / "other.py").write_text(OTHER_VERSION)
    worker = cluster.start_worker("--preload", str(preload), "--name", "other")
    try:
        with cluster.connected() as client:
            client.wait_for_workers(WORKERS + 1, timeout=LONG_S)
            executor = client.get_executor(workers=["other"])
            with pytest.raises(ExecutorError, match=r"has skillc 0\.0 of 12, MuJoCo 3, here it is .*; install"):
                list(run_on(executor, Faulty, range(2)))
    finally:
        end(worker, cluster)


def test_learning_goes_on_when_a_worker_is_killed(cluster: Cluster, tmp_path: Path) -> None:
    (notes := tmp_path / "notes").mkdir()
    worker = cluster.start_worker()
    with closing(open_study(tmp_path / "out", 1)) as study, cluster.connected() as client:
        client.wait_for_workers(WORKERS + 1, timeout=LONG_S)
        study.use_sampler("tpe", 10, 0)
        steps = Search(study, aim("time"), range(3), 10, WORKERS + 1).run(
            client.get_executor(pure=False), partial(Wiping, notes), 60.0
        )
        for number, _ in enumerate(steps):
            if number == WORKERS:
                worker.kill()
        assert len(study.candidates) == 10
        assert all(set(each.worlds) == set(range(3)) for each in study.candidates.values())
        assert all(not world.failures for each in study.candidates.values() for world in each.worlds.values())
    end(worker, cluster)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_what_runs_for_a_client_that_is_ended_ends(cluster: Cluster, noted: Path, number: signal.Signals) -> None:
    command = (sys.executable, "-c", CLIENT, cluster.address, str(noted))
    client = subprocess.Popen(command, env=cluster.environment, stderr=subprocess.DEVNULL)
    wait_until(lambda: len(read_notes(noted)) >= WORKERS)
    client.send_signal(number)
    client.wait()
    wait_until(lambda: not any(alive(pid) for _, pid, _ in read_notes(noted)))


def test_trials_of_workers_that_are_killed_are_run_by_others_and_counted_once(cluster: Cluster, noted: Path) -> None:
    killed: list[int] = []

    def kill_two() -> None:
        wait_until(lambda: len({host for _, _, host in read_notes(noted)}) == WORKERS)
        killed.extend(sorted({host for _, _, host in read_notes(noted)})[:2])
        for host in killed:
            os.kill(host, signal.SIGKILL)

    killer = threading.Thread(target=kill_two)
    killer.start()
    with cluster.connected() as client:
        found = [each.trial for each in run_on(client.get_executor(), partial(Noted, noted, 0.3), range(24))]
    killer.join()
    assert sorted(trial.seed for trial in found) == list(range(24))
    assert [trial.reason for trial in found if trial != good(trial.seed)] == [
        "its process ended with signal 9, in 3 of 3 attempts"
    ]
    begun = [seed for seed, _, _ in read_notes(noted)]
    assert begun.count(KILLED) >= 3 and len(begun) > 24 + 2
    wait_until(lambda: not any(alive(pid) for _, pid, host in read_notes(noted) if host in killed))


def test_trials_end_with_their_scheduler(cluster: Cluster, noted: Path) -> None:
    """It is the last test, since nothing goes on without a scheduler."""

    def kill() -> None:
        wait_until(lambda: bool(read_notes(noted)))
        cluster.scheduler.kill()

    killer = threading.Thread(target=kill)
    killer.start()
    with pytest.raises(ExecutorError, match="the executor has given the trials up"), cluster.connected() as client:
        list(run_on(client.get_executor(), partial(Noted, noted, 600.0), range(30, 34)))
    killer.join()
    wait_until(lambda: not any(alive(pid) for _, pid, _ in read_notes(noted)))


def end(worker: subprocess.Popen[bytes], cluster: Cluster) -> None:
    """End a worker, and wait until the scheduler has noticed."""
    worker.terminate()
    worker.wait()
    with cluster.connected() as client:
        wait_until(lambda: len(client.scheduler_info(n_workers=-1)["workers"]) <= WORKERS)
