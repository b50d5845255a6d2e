"""The page on the world model is true: its examples are executed and print what it says."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import Any

import pytest

from docs.pages import ROOT, blocks

PAGE = ROOT / "docs" / "world-model.md"


def test_every_example_prints_what_stands_below_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"Path": Path}
    printed, compared = io.StringIO(), 0
    for block in blocks(PAGE):
        if block.language == "python":
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(block.text, f"{PAGE.name}", "exec"), names)  # what the page shows is to be run
        elif block.language == "text":
            compared += 1
            assert printed.getvalue() == block.text
        else:
            Path(block.words).write_text(block.text, "utf-8")
    assert compared >= 8
