"""Programs that crash, print garbage, hang or are missing: the planner gives up with the reason and leaves nothing."""

import stat
from pathlib import Path

import pytest

from planners.programs import ends
from planning.samples import CLEANED, LAB, WIPING
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.fast_downward.solver import FastDownward, Programs, find_fast_downward
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.process import (
    ProcessEnded,
    ProcessNotStarted,
    ProcessResult,
    ProcessTimedOut,
    RunningProcess,
    machine_limits,
    wait_for_end,
)
from waiting import LONG_S

PROBLEM = pose_problem(WIPING, LAB, CLEANED).problem
TRANSLATE = 'touch task.sas; echo "Translator axioms: 0"'


def program(folder: Path, name: str, script: str) -> str:
    """Write a shell script and return its path."""
    path = folder / name
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


def run_program(command: str, folder: Path, seconds: float) -> ProcessResult:
    """Return how a program ended in a folder, within some seconds."""
    with RunningProcess((command,), folder, "output.txt", machine_limits()) as running:
        wait_for_end((running,), CancelToken(seconds))
        return running.outcome()


def plan(
    folder: Path, translate: str = TRANSLATE, search: str = "exit 12", driver: str = "exit 12", seconds: float = LONG_S
) -> PlanResult:
    """Plan with shell scripts in the place of Fast Downward's programs."""
    programs = Programs(
        (program(folder, "translate", translate),),
        program(folder, "search", search),
        (program(folder, "driver", driver),),
    )
    return FastDownward(programs).plan(PROBLEM, CancelToken(seconds))


BROKEN = [
    ({"translate": 'echo "undeclared object"; exit 31'}, "did not accept the problem", "undeclared object"),
    ({"translate": "kill -SEGV $$"}, "did not accept the problem", "signal 11"),
    ({"search": "kill -SEGV $$"}, "gave up", "signal 11"),
    ({"search": "exit 22"}, "gave up", "out of memory"),
    ({"search": "exit 34"}, "gave up", "heuristic does not support"),
    ({"search": "head -c 100 /dev/urandom; exit 99"}, "gave up", "code 99"),
    ({"search": 'echo "(fly to the moon)" > proved'}, "invalid plan", "`fly to the moon` is not an action"),
    ({"search": "head -c 1000 /dev/urandom > proved; printf '(\\377' >> proved"}, "invalid plan", ""),
    ({"search": "exit 22", "driver": 'echo "(drive)" > found.1; exit 23'}, "invalid plan", "`drive` is not an action"),
]


@pytest.mark.parametrize(("scripts", "what", "why"), BROKEN)
def test_a_program_that_fails_is_a_planner_that_gives_up(
    tmp_path: Path, scripts: dict[str, str], what: str, why: str
) -> None:
    result = plan(tmp_path, **scripts)
    assert isinstance(result, GaveUp)
    assert what in result.why and why in result.why


def test_proof_of_unsolvability_and_best_found_plans_are_told_apart(tmp_path: Path) -> None:
    words = next(" ".join(("drive", *each)) for each in _arguments())
    proved = plan(tmp_path, search=f'printf "({words})\\n; cost = 12\\n" > proved')
    assert isinstance(proved, Solved) and proved.optimal == "proven"
    twice = f'for n in 1 10; do printf "({words})\\n; cost = 12\\n" > found.$n; done; exit 23'
    found = plan(tmp_path, search="exit 23", driver=twice)
    assert isinstance(found, Solved) and found.optimal == "best found" and len(found.plan.steps) == 1
    assert isinstance(plan(tmp_path, search="exit 11"), Unsolvable)
    assert isinstance(
        plan(tmp_path, search='echo "Completely explored state space -- no solution!"; exit 12'), Unsolvable
    )


def _arguments() -> list[tuple[str, ...]]:
    names = {iri: name for name, iri in PROBLEM.names.items()}
    action = PROBLEM.domain.action["drive"]
    by_type = {each.name: each.type for each in PROBLEM.objects}
    fits = {
        each.name: sorted(n for n in names.values() if PROBLEM.domain.is_a(by_type[n], each.type))
        for each in action.parameters
    }
    return [tuple(fits[each.name][0] for each in action.parameters)]


def test_a_program_that_hangs_is_killed_with_all_it_started(tmp_path: Path) -> None:
    pid_file = tmp_path / "child.pid"
    script = program(tmp_path, "hang", f"sleep 60 & echo $! > {pid_file}; wait")
    seconds = 0.25
    while not (pid_file.exists() and pid_file.read_text()):
        seconds *= 2
        assert isinstance(run_program(script, tmp_path, seconds), ProcessTimedOut)
    assert ends(int(pid_file.read_text()))


def test_what_a_program_leaves_running_is_killed_too(tmp_path: Path) -> None:
    pid_file = tmp_path / "child.pid"
    script = program(tmp_path, "leave", f"sleep 60 & echo $! > {pid_file}; echo done; exit 3")
    ended = run_program(script, tmp_path, LONG_S)
    assert isinstance(ended, ProcessEnded) and ended.code == 3 and ended.last_line == "done"
    assert ends(int(pid_file.read_text()))


def test_a_planner_that_hangs_gives_up_in_time(tmp_path: Path) -> None:
    result = plan(tmp_path, search="sleep 60", driver="sleep 60", seconds=0.5)
    assert isinstance(result, GaveUp) and "ran out of time" in result.why


def test_a_program_that_is_missing_is_not_started(tmp_path: Path) -> None:
    assert isinstance(run_program(str(tmp_path / "nothing"), tmp_path, 1.0), ProcessNotStarted)


@pytest.mark.skipif(find_fast_downward() is None, reason="the planner is an extra")
def test_nothing_is_left_in_the_temporary_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    programs = find_fast_downward()
    assert programs is not None
    assert isinstance(FastDownward(programs).plan(PROBLEM, CancelToken(LONG_S)), Solved)
    assert not list(tmp_path.iterdir())
