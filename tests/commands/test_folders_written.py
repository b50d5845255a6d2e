"""Folders that commands write to: a new library is whole or not there, and a report that fails hides no outcome."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest
from click.testing import CliRunner

from commands.test_output import lab, skillc_in
from skillc.cli.main import skillc
from skillc.services.run import report as run_report
from skillc.services.tasks import loading as task_loading

GOAL = "lab:b contain lab:crate"
__all__ = ["lab"]


def full(*_: object) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("name", ["press_panel", "shelves/of/press_panel"])
def test_a_new_library_is_whole_or_not_there(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write = Path.write_text

    def fills_up(self: Path, text: str, encoding: str | None = None) -> int:
        if self.name == "cell.ttl":
            full()
        return write(self, text, encoding=encoding)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_text", fills_up)
        failed = CliRunner().invoke(skillc, ["new", name])
    assert failed.exit_code == 1
    assert failed.stderr == f"error: cannot create {name}: No space left on device; nothing was written\n"
    assert list(tmp_path.iterdir()) == []
    again = CliRunner().invoke(skillc, ["new", name])
    assert again.exit_code == 0
    assert [each.name for each in (tmp_path / name).parent.iterdir()] == ["press_panel"]


def test_a_folder_that_cannot_be_made_is_told_first(lab: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (lab / "file").touch()
    monkeypatch.setattr(task_loading, "load_task", lambda *_: pytest.fail("the task was loaded"))
    result = skillc_in(lab, "run", GOAL, "--out", str(lab / "file" / "out"))
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr.startswith(f"error: cannot write to {lab / 'file' / 'out'}: ")


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_a_report_that_cannot_be_written_hides_no_outcome(
    form: list[str], lab: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_report, "write_page", full)
    result = skillc_in(lab, "run", GOAL, "--out", str(lab / "out"), *form)
    assert result.exit_code == 1
    assert f"error: cannot write to {lab / 'out'}: No space left on device" in result.stderr
    assert "Carry" in result.stdout and "report:" not in result.stdout
