"""The colours of VS Code come from the table of tokens; vscode-tmgrammar-test checks what they say (make editors)."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from fuzz.kinds._growth import MOST_EXPONENT, measure_growth
from skillc_dsl.token_table import KEYWORDS

EDITORS = Path(__file__).parents[2] / "editors"


def test_every_keyword_has_a_colour() -> None:
    grammar = json.loads((EDITORS / "vscode" / "syntaxes" / "skill.tmLanguage.json").read_text("utf-8"))
    coloured = {word for rule in grammar["patterns"] for word in re.findall(r"\w+", rule["match"])}
    listed = [word for words in KEYWORDS.values() for word in words]
    assert listed
    assert set(listed) <= coloured


@pytest.mark.slow
@pytest.mark.parametrize("piece", ["a", "1", "a1", " ", "#", '"', '\\"'])
def test_long_lines_are_coloured_in_linear_time(piece: str) -> None:
    grammar = json.loads((EDITORS / "vscode" / "syntaxes" / "skill.tmLanguage.json").read_text("utf-8"))
    patterns = [re.compile(rule["match"]) for rule in grammar["patterns"]]
    assert patterns
    growth = measure_growth(lambda text: [each.search(text) for each in patterns], lambda count: piece * count, 30_000)
    assert growth.exponent <= MOST_EXPONENT, growth


def test_the_lock_file_names_no_registry() -> None:
    lock = json.loads((EDITORS / "vscode" / "package-lock.json").read_text("utf-8"))
    assert lock["packages"]
    assert not [name for name, package in lock["packages"].items() if "resolved" in package]


def test_the_client_stays_small() -> None:
    files = sorted((EDITORS / "vscode" / "src").glob("*.ts"))
    assert files
    assert all(len(each.read_text("utf-8").split("\n")) <= 60 for each in files)


def test_the_client_carries_out_the_commands_of_all_lenses() -> None:
    named = (EDITORS / "vscode" / "src" / "commands.ts").read_text("utf-8")
    commands = {"skillc.showReferences", *(f"skillc.{kind}" for kind in ("run", "plan", "test"))}
    assert all(f'"{each}"' in named for each in commands)
