"""What commands print in terminals of several widths, and in which colours."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.layout import TableCell, TerminalPage
from skillc.cli.main import skillc

IRI = "http://example.org/a/very/long/path/that/has/no/place/to/break/at#Thing-With-A-Name"
COMMANDS = ("tasks", "doctor", "new --list", "explain", "plan contact:press_button")


@pytest.mark.parametrize("width", [60, 80, 160])
@pytest.mark.parametrize("command", COMMANDS)
def test_no_line_is_wider_than_the_terminal_or_ends_with_blanks(
    command: str, width: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    result = CliRunner().invoke(skillc, command.split())
    lines = result.stdout.splitlines()
    assert result.exit_code == 0 and len(lines) > 1
    assert [line for line in lines if len(line) > width or line != line.rstrip()] == []


@pytest.mark.parametrize("width", [60, 80])
def test_a_name_that_is_too_long_is_not_broken(width: int) -> None:
    page = TerminalPage(width)
    assert page.wrap(f"see {IRI} there", hanging="  ") == ["see", f"  {IRI}", "  there"]
    assert page.columns([("a", "b"), (TableCell("thing", "name"), IRI)])[-1] == f"    {IRI}"


def test_colours_are_used_as_they_are_asked_for() -> None:
    for options, coloured in (("--color always", True), ("--color never", False), ("", False)):
        result = CliRunner().invoke(skillc, ["tasks", *options.split()], color=True)
        assert ("\x1b[" in result.stdout) == coloured
    assert (
        "\x1b["
        not in CliRunner().invoke(skillc, ["tasks"], color=True, env={"FORCE_COLOR": "1", "NO_COLOR": "1"}).stdout
    )


def test_json_has_an_option_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "a.skill").write_text("skill X { in a: Nope }\n", encoding="utf-8")
    found = json.loads(CliRunner().invoke(skillc, ["check", str(tmp_path), "--json", "-q"]).stdout)
    assert [each["severity"] for each in found] and CliRunner().invoke(
        skillc, ["check", "-q", str(tmp_path)]
    ).stderr == ""
    refused = CliRunner().invoke(skillc, ["check", str(tmp_path), "--format", "json"])
    assert refused.exit_code == 2 and "write `--json`" in refused.stderr
