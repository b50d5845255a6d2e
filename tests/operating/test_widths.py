"""In terminals of any width lines are wrapped by words, and no progress bar is left behind."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.terminal_pictures import COMMANDS, WIDTHS, picture_file, run_session


@pytest.mark.sim
@pytest.mark.parametrize("columns", [60, max(WIDTHS)])
def test_a_project_is_checked_planned_run_and_tried(columns: int, tmp_path: Path) -> None:
    lines = [each.plain for each in run_session(tmp_path, columns)]
    assert [each for each in lines if len(each) > columns] == []
    text = "\n".join(lines)
    assert all(f"$ skillc {command}" in text for command in COMMANDS)
    assert "error[unknown-relation]: there is no relation `contian`" in text
    assert "finished, not verified" in text and "3 of 3 trials passed" in text
    assert not {"━", "╸", "⠼", "⠋"} & set(text), "nothing is left of a bar"


@pytest.mark.parametrize("columns", WIDTHS)
def test_the_pictures_of_terminals_show_the_session(columns: int) -> None:
    picture = picture_file(columns).read_text("utf-8").replace("&#160;", " ")
    assert [command for command in COMMANDS if f"$ skillc {command}" not in picture] == []
    assert "@font-face" not in picture
