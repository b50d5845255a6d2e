"""Part 1 of the page about the language, done as it says in an empty folder."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from docs.pages import ROOT, Reader
from skillc.cli.main import skillc


@pytest.mark.slow
def test_every_step_works_and_its_files_are_laid_out_as_the_formatter_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "500")
    reader = Reader(monkeypatch)
    reader.follow(ROOT / "docs/language.md")
    assert reader.done >= 15
    formatted = CliRunner().invoke(skillc, ["fmt", "--check", "."])
    assert formatted.exit_code == 0, formatted.output
