"""Whoever runs something takes the fields of its specification as keyword arguments, and as options, by one word."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click
import pytest
from click.testing import CliRunner

import run_form
import run_keywords
import skillc
from skillc.cli.main import skillc as command_line
from skillc.cli.struct_options import parameter_name
from skillc.client.async_cell import AsyncCell
from skillc.values.run_keywords import RunKeywords, StartKeywords
from skillc_runtime.recording.documented import documented_fields
from skillc_runtime.recording.run_spec import ATTENDED_ELSEWHERE, RunRequest, RunSpec


def test_the_keywords_are_those_of_the_specification() -> None:
    assert run_keywords.FILE.read_text("utf-8") == run_keywords.format_keywords(), "run `python tests/accept.py`"
    assert run_form.FILE.read_text("utf-8") == run_form.format_form(), "run `python tests/accept.py`"
    assert StartKeywords.__optional_keys__ == {*RunSpec.__struct_fields__} - {"task", *ATTENDED_ELSEWHERE}
    assert RunKeywords.__optional_keys__ < StartKeywords.__optional_keys__


@pytest.mark.parametrize(("name", "struct"), [("run", RunSpec), ("start", RunRequest)])
def test_each_field_is_a_parameter_of_the_command_with_its_text(name: str, struct: type[RunRequest]) -> None:
    command = command_line.get_command(click.Context(command_line), name)  # type: ignore[attr-defined]
    texts = {each.name: getattr(each, "help", None) or "" for each in command.params}
    wanted = [each for each in documented_fields(struct) if struct is RunRequest or each.name not in ATTENDED_ELSEWHERE]
    assert len(wanted) > 10
    for each in wanted:
        assert (each.text in texts[parameter_name(each.name)]) == bool(each.section), each.name


CALLS: dict[str, tuple[Callable[[], Any], str]] = {
    "run": (lambda: skillc.run(skill="Wipe()"), "`skill`; it is called `call` now"),  # type: ignore[call-arg]
    "start": (lambda: skillc.start("a", pause_at=["A"]), "`pause_at`; it is called `breakpoints` now"),  # type: ignore[call-arg]
    "scene": (lambda: skillc.open_scene("panda_desk").run(skill="A()"), "it is called `call` now"),  # type: ignore[call-arg]
    "cell": (lambda: AsyncCell(None, "a").start("b", pause_at=["A"]).send(None), "it is called `breakpoints` now"),  # type: ignore[arg-type,call-arg]
    "never": (lambda: skillc.run("a", sed=1), "no keyword `sed`"),  # type: ignore[call-arg]
    "not of run": (lambda: skillc.run("a", step=True), "no keyword `step`"),  # type: ignore[call-arg]
}


@pytest.mark.parametrize("case", CALLS)
def test_a_keyword_of_an_earlier_version_is_told_how_it_is_called_now(case: str) -> None:
    act, sentence = CALLS[case]
    with pytest.raises(TypeError, match=sentence):
        act()


@pytest.mark.parametrize(
    ("words", "now"),
    [
        (("run", "--pause-at", "Wipe"), "--breakpoints"),
        (("run", "--skill", "Wipe()"), "--call"),
        (("start", "--ask"), "--ask-after-failure"),
        (("rehearse", "--skill", "Wipe()"), "--call"),
        (("breakpoints", "--pause-at", "Wipe"), "--breakpoints"),
    ],
)
def test_so_is_an_option(words: tuple[str, ...], now: str) -> None:
    done = CliRunner().invoke(command_line, words)
    assert (done.exit_code, f"there is no option `{words[1]}`; it is called `{now}` now" in done.stderr) == (2, True)


def test_an_option_that_the_command_never_had_is_not_told_another_name() -> None:
    assert "it is called" not in CliRunner().invoke(command_line, ("fmt", "--skill", "a")).stderr
