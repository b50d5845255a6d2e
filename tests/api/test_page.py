"""Every example of the page about Python prints what it says, and is correctly typed."""

from __future__ import annotations

import contextlib
import io
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from docs.pages import ROOT, Block, blocks

PAGE = ROOT / "docs" / "python.md"


def _follow(examples: Iterator[Block]) -> int:
    """Run the examples in one namespace, compare what they print, and return how many outputs were compared."""
    names: dict[str, Any] = {"Path": Path}
    printed, compared = io.StringIO(), 0
    for block in examples:
        if block.language == "python":
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(block.text, "python.md", "exec"), names)  # what the page shows is to be run
        elif block.language == "text":
            compared += 1
            assert printed.getvalue() == block.text
    return compared


@pytest.mark.sim
def test_everything(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert _follow(blocks(PAGE)) >= 10
    assert Path("plan.svg").read_text().startswith("<svg")


@pytest.mark.sim
def test_examples_are_typed(tmp_path: Path) -> None:
    examples = tmp_path / "examples.py"
    texts = [block.text for block in blocks(PAGE) if block.language == "python"]
    examples.write_text("from pathlib import Path\n\n" + "\n".join(texts), "utf-8")
    command = (sys.executable, "-m", "mypy", "--config-file", ROOT / "pyproject.toml", "--strict", examples)
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stdout
