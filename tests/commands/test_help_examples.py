"""The examples in the help of commands: each is a command line that exists, and those that are done in seconds run."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from skillc.cli.command import Command
from skillc.cli.main import skillc

PROJECT = (
    "skillc check",
    "skillc check --fix",
    "skillc check --format github",
    "skillc fix",
    "skillc fix --edition",
    "skillc fix --edition --diff",
    'skillc plan --scene cell.ttl --goal "lab:Box-A contain lab:Part-A"',
    "skillc test",
    "skillc test --coverage --junit tests.xml",
)
"""Those that are about a project with a cell, as `skillc new` makes it."""
SHIPPED = (
    "skillc new --list",
    "skillc new press_button",
    "skillc plan clean_table",
    'skillc plan clean_table --always "not lab:Iiwa-1.deviceState == Fault"',
    "skillc plan wiping:clean_both --minimise makespan --json",
)
"""Those that need no project."""
RUNS = ("skillc run clean_table --out out", "skillc report out", "skillc replay out --check")


def examples(group: click.Group = skillc, above: tuple[str, ...] = ("skillc",)) -> Iterator[tuple[Command, str, str]]:
    """Yield the commands of a group and of the groups in it, with their names and each of their examples."""
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if isinstance(command, click.Group):
            yield from examples(command, (*above, name))
        elif isinstance(command, Command):
            whole = " ".join((*above, name))
            yield from ((command, whole, line.strip()) for line in command.examples.splitlines() if line.strip())


def run(line: str) -> str:
    """Run an example; its output."""
    result = CliRunner().invoke(skillc, shlex.split(line)[1:])
    assert result.exit_code == 0, (line, result.output, result.exception)
    return result.output


def test_all_examples_have_options_that_exist() -> None:
    found = list(examples())
    lines = [line for _, _, line in found]
    assert len(lines) > 70 and {*PROJECT, *SHIPPED, *RUNS, "skillc new sorting --template pick-place"} <= {*lines}
    for command, name, line in found:
        assert line == name or line.startswith(f"{name} "), line
        command.make_context(name, shlex.split(line.removeprefix(name)), parent=click.Context(skillc))


@pytest.mark.slow
def test_examples_run_in_a_new_project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run("skillc new sorting --template pick-place")
    monkeypatch.chdir(tmp_path / "sorting")
    for line in PROJECT:
        run(line)
    assert Path("tests.xml").is_file()


@pytest.mark.slow
@pytest.mark.parametrize("line", SHIPPED)
def test_examples_run_without_a_project(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(line)


@pytest.mark.slow
@pytest.mark.sim
def test_a_run_is_reported_and_repeated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for line in RUNS:
        run(line)
