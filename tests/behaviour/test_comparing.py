"""Saved behaviours are compared without what differs at each run, and what differs otherwise is shown."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from behaviour.__main__ import main
from behaviour.comparing import ABOUT, SHOWN_FILES, compare
from behaviour.kinds import kind_names, load_kind

RUN = 'carry-20260131T120000Z-1f0c9a\n{"wall_time_s": 4.2, "started_ns": 1795837973340385388, "steps": 3}\n'
AGAIN = 'carry-20270209T080000Z-77e1b0\n{"wall_time_s": 57.1, "started_ns": 1795938321429229052, "steps": 3}\n'


def saved(folder: Path, files: dict[str, str]) -> Path:
    """Write a behaviour of the kind `runs`, saved in `folder`."""
    (folder / "runs").mkdir(parents=True)
    (folder / ABOUT).write_text(json.dumps({"runs": {"roots": {str(folder): "checkout"}}}))
    for name, text in files.items():
        (folder / "runs" / name).write_text(f"{folder}/cell.ttl {text}")
    return folder


def test_places_times_and_ids_are_no_difference(tmp_path: Path) -> None:
    before, after = saved(tmp_path / "a", {"one": RUN}), saved(tmp_path / "b" / "deeper", {"one": AGAIN})
    assert compare(before, after) == {"runs": []}


@pytest.mark.parametrize("files", [{"one": RUN.replace("3}", "4}")}, {}, {"one": RUN, "two": ""}])
def test_what_differs_is_shown_and_the_exit_code_is_1(
    files: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before, after = saved(tmp_path / "a", {"one": RUN}), saved(tmp_path / "b", files)
    monkeypatch.setattr("sys.argv", ["behaviour", "compare", str(before), str(after)])
    assert main() == 1
    told = capsys.readouterr().out
    assert any(each in told for each in ('"steps": 4}', "--- one is missing", "+++ two is new")), told


def test_not_more_than_some_files_are_shown(tmp_path: Path) -> None:
    many = {f"file-{number}": "" for number in range(SHOWN_FILES + 3)}
    (lines,) = compare(saved(tmp_path / "a", {}), saved(tmp_path / "b", many)).values()
    assert len(lines) == 1 + SHOWN_FILES + 1 and "3 more" in lines[-1]


def test_the_quick_kinds_come_first() -> None:
    simulates = [load_kind(name).SIMULATES for name in kind_names()]
    assert simulates == sorted(simulates) and {True, False} == set(simulates)
