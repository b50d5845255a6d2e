"""`skillc report`: the report of a recording is that of the run; what cannot be repeated has none."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_runtime.recording.run_spec import RunSpec
from why.test_replay_check import edit, record, recorded, run

pytestmark = pytest.mark.slow

__all__ = ["recorded", "run"]
WALL_TIMES = ("wall_time_s", "real_time_factor")


def report(*arguments: object) -> Result:
    result = CliRunner().invoke(skillc, ["report", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def read_result(folder: Path) -> dict[str, object]:
    values: dict[str, object] = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    return {name: value for name, value in values.items() if name not in WALL_TIMES}


def test_a_lost_report_is_made_again(run: Path) -> None:
    before = read_result(run)
    for name in ("result.json", "report.html"):
        (run / name).unlink()
    result = report(run, "--library", run.parent)
    assert result.exit_code == 0 and "Deliver  succeeded" in result.stdout, result.output
    assert read_result(run) == before
    assert "Deliver" in (run / "report.html").read_text(encoding="utf-8")


def test_a_recording_that_was_changed_has_no_report(run: Path) -> None:
    edit(run, '"reason":"requested"', '"reason":"tea"')
    (run / "report.html").unlink()
    result = report(run, "--library", run.parent)
    assert result.exit_code == 1 and "is another one when it is repeated" in " ".join(result.stderr.split())
    assert not (run / "report.html").exists()


def test_a_recording_without_end_has_no_report(run: Path) -> None:
    file = run / "events.jsonl"
    file.write_bytes(b"".join(file.read_bytes().splitlines(keepends=True)[:-1]))
    result = report(run, "--library", run.parent)
    assert result.exit_code == 1 and "the recording ends before the run" in " ".join(result.stderr.split())


def test_a_file_needs_a_folder_for_its_report(run: Path) -> None:
    result = report(run / "recording.mcap")
    assert result.exit_code == 2 and "--out" in result.stderr


@pytest.mark.early
@pytest.mark.sim
def test_figures_are_those_of_the_run(tmp_path: Path) -> None:
    record(RunSpec(task="contact:press_button"), tmp_path / "run", 3.0, "mujoco")
    again = tmp_path / "again"
    assert report(tmp_path / "run/recording.mcap", "--film-quality", "draft", "--out", again).exit_code == 0
    assert read_result(again) == read_result(tmp_path / "run")
    figures = sorted(path.name for path in (tmp_path / "run").glob("*.svg"))
    assert figures == sorted(path.name for path in again.glob("*.svg")) and "push.svg" in figures
    for name in figures:
        assert (again / name).read_bytes() == (tmp_path / "run" / name).read_bytes()
    films = [(each / "film.mp4").exists() for each in (tmp_path / "run", again)]
    pages = ["film.mp4" in (each / "report.html").read_text(encoding="utf-8") for each in (tmp_path / "run", again)]
    assert films == pages == [False, True], "the run was without"
