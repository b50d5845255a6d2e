"""`skillc trials` as a user meets it, with trials that need no simulation."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc import extras
from skillc.cli.main import skillc
from skillc.services.library import compiled_libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.tasks import loading as task_loading
from skillc.services.trials import running as trial_runs
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.trials import dispatch
from skillc_runtime.evaluation.trials.hosting import Prepare, Tried
from skillc_runtime.evaluation.trials.journal import FILE
from trials.runners import Exits, good, wiping

TILTED = 8
"""A seed at which a target is missed."""


@cache
def shipped() -> SkillLibrary:
    return compiled_libraries.compile_valid(find_library(SHIPPED / "wiping"))


@pytest.fixture(autouse=True)
def asked(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Let trials run in no time; return the seeds that were run."""
    seeds_run: list[int] = []
    library = shipped()

    def run_on(_executor: Executor, _prepare: Prepare, seeds: Sequence[int], _limit_s: float) -> Iterator[Tried]:
        for seed in seeds:
            seeds_run.append(seed)
            yield Tried(good(seed, wiping(tilt_rms_deg=0.9 if seed == TILTED else 0.1)), 4.0)

    monkeypatch.setattr(trial_runs, "run_on", run_on)
    monkeypatch.setattr(task_loading, "compile_valid", lambda files: library)
    return seeds_run


def run(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(skillc, ["trials", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_all_is_well(asked: list[int]) -> None:
    result = run("clean_table", "-n", 3, "--seed", 4)
    assert result.exit_code == 0
    assert asked == [4, 5, 6]
    assert "3 of 3 trials passed" in result.stdout
    assert "seed 6: passed (3 of 3)" in result.stderr


def test_a_missed_target_is_exit_code_3_and_json_has_it_all() -> None:
    result = run("clean_table", "-n", 2, "--seed", 7, "--json")
    assert result.exit_code == 3
    assert result.stderr == ""
    told = json.loads(result.stdout)
    assert [told[name] for name in ("task", "wanted", "done", "passed")] == ["clean_table", 2, 2, 1]
    (failed,) = told["failed"]
    assert (failed["seed"], failed["reasons"]) == (8, ["tilt 0.9 deg rms, wanted at most 0.5 deg rms"])


def test_what_is_kept_is_not_run_again(asked: list[int], tmp_path: Path) -> None:
    out = tmp_path / "trials"
    assert run("clean_table", "-n", 2, "--out", out).exit_code == 0
    first = (out / FILE).read_bytes()
    assert run("clean_table", "-n", 4, "--out", out).exit_code == 0
    assert asked == [0, 1, 2, 3]
    assert (out / FILE).read_bytes().startswith(first)
    assert "4 of 4 trials passed" in (out / "trials.html").read_text(encoding="utf-8")


def test_other_trials_in_the_folder_are_refused(asked: list[int], tmp_path: Path) -> None:
    run("clean_table", "-n", 1, "--out", tmp_path)
    other = run("clean_desk", "-n", 1, "--out", tmp_path)
    assert other.exit_code == 1
    assert other.stderr.startswith("error: the trials in ")
    assert "are of another task: clean_table, now it is clean_desk" in other.stderr
    disturbed = run("clean_table", "-n", 1, "--disturb", "push", "--out", tmp_path)
    assert (disturbed.exit_code, "are of another disturbance: none, now it is push" in disturbed.stderr) == (1, True)
    assert asked == [0]


def test_a_file_where_a_folder_is_wanted_is_one_clear_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    result = run("clean_table", "-n", 1, "--out", tmp_path / "file" / "below")
    assert result.exit_code == 1
    assert result.stderr.startswith("error: cannot write to ")


def test_a_page_that_cannot_be_written_hides_no_outcome(tmp_path: Path) -> None:
    (tmp_path / trial_runs.PAGE).mkdir()
    result = run("clean_table", "-n", 1, "--out", tmp_path)
    assert result.exit_code == 1
    assert "1 of 1 trials passed" in result.stdout
    assert "error: cannot write to " in result.stderr


def test_interrupted_it_keeps_what_is_done_and_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def interrupted(_executor: Executor, _prepare: Prepare, seeds: Sequence[int], _limit_s: float) -> Iterator[Tried]:
        yield Tried(good(seeds[0]), 4.0)
        raise KeyboardInterrupt

    monkeypatch.setattr(trial_runs, "run_on", interrupted)
    result = run("clean_table", "-n", 3, "--out", tmp_path)
    assert result.exit_code == 3
    assert "interrupted" in result.stderr and "1 of 3 trials passed, 2 not done" in result.stdout


def test_that_no_process_can_run_trials_is_one_clear_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(trial_runs, "run_on", dispatch.run_on)
    monkeypatch.setattr(trial_runs, "prepare_runner", Exits)
    result = run("clean_table", "-n", 3, "--out", tmp_path)
    assert result.exit_code == 1 and result.stdout == ""
    why = f"the worker on {socket.gethostname()} cannot run the trials: its process ended with code 5"
    assert result.stderr == f"error: no more trials can be run: {why}\n"


@pytest.mark.parametrize(
    "arguments", [("no_such_task",), ("clean_table", "-n", 0), ("clean_table", "--disturb", "rain")]
)
def test_wrong_words_are_exit_code_2(arguments: tuple[str, ...]) -> None:
    assert run(*arguments).exit_code == 2


@pytest.mark.parametrize(("disturbance", "lacking"), [("missing", "fixture or person"), ("obstacle", "or fixture")])
def test_a_disturbance_that_changes_nothing_is_refused(
    asked: list[int], monkeypatch: pytest.MonkeyPatch, disturbance: str, lacking: str
) -> None:
    sorting = compiled_libraries.compile_valid(find_library(SHIPPED / "sorting"))
    monkeypatch.setattr(task_loading, "compile_valid", lambda files: sorting)
    refused = run("sorting:sort_parts", "-n", 1, "--disturb", disturbance)
    assert refused.exit_code == 2 and asked == []
    assert f"`{disturbance}` changes nothing here: the scene has no surface" in refused.stderr
    assert f"{lacking}\n" in refused.stderr
    assert run("sorting:sort_parts", "-n", 1, "--disturb", "take").exit_code != 2 and asked == [0]


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (("--scheduler", "tcp://10.0.0.5:8786"), 2, "use TLS, tls://10.0.0.5:8786, with the certificates"),
        (("--scheduler", "cluster:8786"), 2, "use TLS, tls://cluster:8786, with the certificates"),
        (("--scheduler", "tls://cluster:8786", "--jobs", 2), 2, "--jobs is the number of processes here"),
        (("--scheduler", "tls://cluster:8786", "--cell", "table"), 2, "--scheduler"),
    ],
)
def test_a_scheduler_that_cannot_be_used_is_refused(arguments: tuple[str, ...], code: int, said: str) -> None:
    result = run("clean_table", "-n", 2, *arguments)
    assert (result.exit_code, result.stdout) == (code, "") and said in result.stderr


def test_a_scheduler_needs_an_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extras, "find_spec", lambda _name: None)
    result = run("clean_table", "-n", 2, "--scheduler", "127.0.0.1:8786")
    assert (result.exit_code, "pip install 'skillc[cluster]'" in result.stderr) == (2, True)
