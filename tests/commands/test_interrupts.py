"""A command that a signal ends while it plans says so, and leaves neither processes nor files."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from uuid import uuid4

import pytest

from skillc_runtime.planning.fast_downward.solver import find_fast_downward
from waiting import wait_until

PLACES, TRUCKS, CRATES = 7, 4, 14
SKILLS = """
use sumo
class Depot < Object
class Crate < Object
class Truck < Object
relation stands(Truck, Depot) functional
relation in_(Crate, Object) functional
relation stores(Object, Crate) inverse in_

skill Drive {
    in    truck: Truck
    in    to:    Depot
    infer from:  Depot
    pre   truck stands from
    pre   not from == to
    post  truck stands to
    duration 5 s
}
impl wheels of Drive { run python "skillc.primitives:StandIn" }

skill Load {
    in    truck: Truck
    in    crate: Crate
    infer from:  Depot
    pre   truck stands from
    pre   from stores crate
    pre   not truck stores _
    post  truck stores crate
    duration 2 s
}
impl forks of Load { run python "skillc.primitives:StandIn" }

skill Unload {
    in    truck: Truck
    in    crate: Crate
    infer to:    Depot
    pre   truck stands to
    pre   truck stores crate
    post  to stores crate
    duration 2 s
}
impl forks of Unload { run python "skillc.primitives:StandIn" }
"""
HEAD = "@prefix lab: <http://example.org/lab#> . @prefix lib: <https://w3id.org/skillc/library/depot#> .\n"
GOAL = " and ".join(f"lab:d{(n + 1) % PLACES} stores lab:c{n}" for n in range(CRATES))

pytestmark = pytest.mark.skipif(find_fast_downward() is None, reason="the planner is an extra")


@pytest.fixture(scope="module")
def depot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a library, with a scene for which no planner can prove in hours that a plan is the shortest."""
    folder = tmp_path_factory.mktemp("interrupts") / "depot"
    folder.mkdir()
    (folder / "depot.skill").write_text(SKILLS, encoding="utf-8")
    things = [f"lab:d{n} a lib:Depot ." for n in range(PLACES)]
    things += [f"lab:t{n} a lib:Truck ; lib:stands lab:d{n} ." for n in range(TRUCKS)]
    things += [f"lab:c{n} a lib:Crate . lab:d{n % PLACES} lib:stores lab:c{n} ." for n in range(CRATES)]
    (folder / "scene.ttl").write_text(HEAD + "\n".join(things), encoding="utf-8")
    return folder


def marked(mark: str) -> Iterator[int]:
    """Yield the processes that run with a mark in their environment."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (folder / "environ").read_bytes():
                yield int(folder.name)
        except OSError:
            continue


def interrupted(depot: Path, command: str, send: Callable[[int], None]) -> tuple[int, str, str, Path]:
    """Send a signal to a command while its planners search; return its code and output, and its temporary folder."""
    temporary, mark = depot.parent / uuid4().hex, uuid4().hex
    temporary.mkdir()
    environment = {**os.environ, "TMPDIR": str(temporary), "MARK": mark, "PYTHONPATH": os.pathsep.join(sys.path)}
    place = ("--library", str(depot), "--scene", str(depot / "scene.ttl"))
    arguments = (command, *place, "--goal", GOAL, "--no-plan-cache")
    process = subprocess.Popen(
        (sys.executable, "-m", "skillc", *arguments),
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        wait_until(lambda: bool(list(temporary.glob("*/proving0.txt"))) or process.poll() is not None)
        send(process.pid)
        out, err = process.communicate(timeout=60.0)
        wait_until(lambda: not list(marked(mark)))
    finally:
        os.killpg(process.pid, signal.SIGKILL) if process.poll() is None else None
    return process.returncode, out, err, temporary


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "code", "said"),
    [
        (signal.SIGINT, 130, "interrupted"),
        (signal.SIGTERM, 143, "ended by SIGTERM"),
        (signal.SIGHUP, 129, "ended by SIGHUP"),
    ],
)
def test_a_signal_ends_planning(depot: Path, number: signal.Signals, code: int, said: str) -> None:
    ended, out, err, temporary = interrupted(depot, "plan", lambda pid: os.killpg(pid, number))
    assert (ended, out) == (code, "")
    assert [line for line in err.splitlines() if "preparing" not in line and "planning" not in line] == [said]
    assert not list(temporary.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "said"),
    [
        (signal.SIGINT, "interrupted"),
        pytest.param(signal.SIGTERM, "ended by SIGTERM", marks=pytest.mark.sim),
    ],
)
def test_a_signal_stops_a_task_that_is_planned(depot: Path, number: signal.Signals, said: str) -> None:
    ended, out, _, temporary = interrupted(depot, "run", lambda pid: os.killpg(pid, number))
    assert ended == 3 and "stopped" in out and said in out
    assert not list(temporary.iterdir())


def test_a_second_signal_ends_it_at_once(depot: Path) -> None:
    def twice(pid: int) -> None:
        os.kill(pid, signal.SIGTERM)
        os.kill(pid, signal.SIGINT)

    code, out, err, _ = interrupted(depot, "plan", twice)
    ended_already = -signal.SIGINT  # Python handles no signals any more once it has cleaned up
    assert code in (130, 143, ended_already) and out == "" and "Traceback" not in err


def test_a_second_signal_after_the_first_was_handled_prints_no_traceback() -> None:
    program = """
import contextlib, os, signal
from skillc.cli.interrupts import Interrupted, raising_on_signals
with contextlib.suppress(Interrupted), raising_on_signals():
    os.kill(os.getpid(), signal.SIGTERM)
os.kill(os.getpid(), signal.SIGINT)
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, encoding="utf-8", check=False)
    assert (ended.returncode, ended.stderr) == (130, "")


def test_a_command_that_is_killed_leaves_nothing_either(depot: Path) -> None:
    code, _, _, temporary = interrupted(depot, "plan", lambda pid: os.kill(pid, signal.SIGKILL))
    assert code == -signal.SIGKILL
    wait_until(lambda: not list(temporary.iterdir()))
