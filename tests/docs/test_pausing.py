"""The page on pausing names each state with what it allows, each key and option; its picture is what is shown."""

from __future__ import annotations

import re

import pytest

from docs.pages import ROOT
from docs.pause_picture import PICTURE, draw, read_text
from skillc.cli.commands.run import command
from skillc.cli.progress.run_keys import FASTER, KEYS, SLOWER
from skillc_runtime.execution.task_state import ALLOWED, ALLOWED_AFTER_FAILURE

PAGE = (ROOT / "docs/pausing.md").read_text(encoding="utf-8")


def rows(heading: str) -> list[list[str]]:
    """Return the cells of the table below a heading, without its head."""
    section = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def words(cell: str) -> tuple[str, ...]:
    return tuple(re.findall(r"`([^`]+)`", cell))


def test_the_table_of_states_is_that_of_the_code() -> None:
    assert {words(state)[0]: words(allowed) for state, _, allowed, *_ in rows("States")} == ALLOWED
    after_failure = PAGE.partition("because a step failed")[2].partition(".")[0]
    assert words(after_failure) == ALLOWED_AFTER_FAILURE


def test_the_table_of_keys_is_that_of_the_code() -> None:
    assert sorted(key for cells in rows("Keys") for key in words(cells[0])) == sorted(
        (*(key.letter for key in KEYS), FASTER, SLOWER)
    )


def test_the_options_exist() -> None:
    options = {name for parameter in command.params for name in parameter.opts}
    named = {option for cells in rows("Options") for option in re.findall(r"--[a-z-]+", cells[0])}
    assert len(named) == 8 and named <= options


@pytest.mark.sim
def test_the_picture_shows_what_the_terminal_shows() -> None:
    assert read_text(PICTURE.read_text(encoding="utf-8")) == read_text(draw())
