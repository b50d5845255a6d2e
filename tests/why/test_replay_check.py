"""`skillc replay --check`: recordings that are right, and what was changed in recordings, libraries and seeds."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from msgspec.structs import replace

from operating.depot import write_depot
from operating.monitors import Monitor
from operating.test_repeating import Operator
from skillc.cli.main import skillc
from skillc.services.project.backends import BackendName
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.recording.run_spec import RunSpec

pytestmark = pytest.mark.slow


def check(*arguments: object) -> Result:
    result = CliRunner().invoke(skillc, ["replay", "--check", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def record(spec: RunSpec, folder: Path, pause_at_s: float, backend: BackendName = "kinematic") -> None:
    """Record a run that is paused, stepped and resumed."""
    spec = replace(spec, out=str(folder), seed=3, backend=backend, film=False)
    with load_task(spec, SilentReporter()) as loaded:
        ran = run_task(loaded, RunOptions(spec), Monitor(Operator(pause_at_s)), SilentReporter())
    assert ran.result.status == "succeeded", ran.result.failure


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("depot")
    write_depot(folder, far_s=1)
    record(RunSpec(scene=str(folder / "scene.ttl"), call="Deliver()", library=str(folder)), folder / "out", 0.5)
    return folder


@pytest.fixture
def run(recorded: Path, tmp_path: Path) -> Path:
    copied: Path = shutil.copytree(recorded, tmp_path / "depot") / "out"
    return copied


def edit(run: Path, old: str, new: str) -> Path:
    """Change the first place of a text in the event file."""
    file = run / "events.jsonl"
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    return run


def test_a_run_with_requests_is_repeated(run: Path) -> None:
    result = check(run, "--library", run.parent)
    count = len((run / "events.jsonl").read_text(encoding="utf-8").splitlines())
    assert result.exit_code == 0, result.output
    assert f"{count} events, each possible after those before it" in result.stdout
    assert f"repeated: {count} events, the same but for wall times" in result.stdout
    assert check(run / "recording.mcap", "--library", run.parent).stdout == result.stdout


def test_a_recording_executes_no_code_that_it_brings_along(run: Path) -> None:
    result = check(run)
    assert result.exit_code == 2
    assert "a recording executes no code: give the library with --library" in " ".join(result.stderr.split())


def test_in_its_project_the_library_need_not_be_given(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    project, start = run.parent, (run / "events.jsonl").read_text(encoding="utf-8").splitlines()[0]
    name = json.loads(start)["event"]["library"]
    (project / "skillc.toml").write_text(f'name = "{name}"\nversion = "0.1.0"\n', encoding="utf-8")
    monkeypatch.chdir(project)
    result = check("out")
    assert result.exit_code == 0 and "the same but for wall times" in result.stdout, result.output
    (project / "skillc.toml").write_text('name = "other"\nversion = "0.1.0"\n', encoding="utf-8")
    assert "or go to the folder of its project" in " ".join(check("out").stderr.split())


def test_a_changed_library_is_found(run: Path) -> None:
    library = run.parent / "depot.skill"
    library.write_text(library.read_text(encoding="utf-8").replace("wait 1 s", "wait 2 s", 1), encoding="utf-8")
    result = check(run, "--library", run.parent)
    assert result.exit_code == 1 and "event 1 cannot be: the run used the library" in result.stdout


def test_the_first_event_that_differs_is_shown_with_both_sides(run: Path) -> None:
    edit(run, '"reason":"requested"', '"reason":"tea"')
    result = check(run, "--library", run.parent, "--json")
    found: dict[str, Any] = json.loads(result.stdout)
    assert result.exit_code == 1 and found["impossible"] is None
    recorded, repeated = found["difference"]["recorded"], found["difference"]["repeated"]
    assert (recorded["type"], recorded["reason"], repeated["reason"]) == ("state-changed", "tea", "requested")
    line = next(each for each in check(run, "--library", run.parent).stdout.splitlines() if each.startswith("reason"))
    assert line.split() == ["reason", "tea", "requested"]


def test_a_request_in_another_tick_is_found(run: Path) -> None:
    lines = (run / "events.jsonl").read_text(encoding="utf-8").splitlines()
    tick = next(each["tick"] for each in (json.loads(line)["event"] for line in lines) if each["type"] == "requested")
    result = check(edit(run, f'"tick":{tick}', f'"tick":{tick + 5}'), "--library", run.parent)
    assert result.exit_code == 1 and "repeated: event" in result.stdout


def test_a_run_that_was_cut_off_is_repeated_up_to_there(run: Path) -> None:
    file = run / "events.jsonl"
    whole = file.read_bytes().splitlines(keepends=True)
    for kept in (1, len(whole) // 2, len(whole) - 1):
        file.write_bytes(b"".join(whole[:kept]))
        result = check(run, "--library", run.parent)
        assert result.exit_code == 0, result.output
        assert f"repeated: {kept} events" in result.stdout


@pytest.mark.sim
def test_another_seed_is_found_as_a_difference_of_the_events(tmp_path: Path) -> None:
    record(RunSpec(task="contact:press_button"), tmp_path, 3.0, "mujoco")
    assert check(tmp_path).exit_code == 0
    (tmp_path / "recording.mcap").unlink()
    assert check(tmp_path).exit_code == 0, "with the shipped library and scene"
    result = check(edit(tmp_path, '"seed":3', '"seed":4'), "--json")
    assert result.exit_code == 1 and json.loads(result.stdout)["difference"]["number"] > 2


@pytest.mark.sim
@pytest.mark.parametrize(
    ("task", "backend"),
    [
        pytest.param("clean_whiteboard", "mujoco", marks=pytest.mark.long),
        pytest.param("clean_table", "mujoco", marks=pytest.mark.long),
        ("contact:insert_peg", "mujoco"),
        ("contact:press_button", "mujoco"),
        pytest.param("clean_both", "kinematic", marks=pytest.mark.long),
        pytest.param("share_eraser", "kinematic", marks=pytest.mark.long),
    ],
)
def test_runs_of_other_arms_are_repeated_from_their_recordings(tmp_path: Path, task: str, backend: BackendName) -> None:
    spec = RunSpec(task=task, out=str(tmp_path), seed=1, backend=backend, film=False)
    with load_task(spec, SilentReporter()) as loaded:
        run_task(loaded, RunOptions(spec), Monitor(lambda run, now: ()), SilentReporter())
    result = check(tmp_path / "recording.mcap")
    assert result.exit_code == 0 and "repeated:" in result.stdout, result.output
