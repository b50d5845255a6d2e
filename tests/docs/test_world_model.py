"""The pages on the world model, space, scenes, obstacles, backends and sensing print what they say they print."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import Any

import pytest

from docs.pages import ROOT, Reader, blocks

PAGES = {"world-model": 8, "bodies": 3, "space": 6, "scenes": 5, "obstacles": 1, "backends": 1, "sensing": 1}
"""Pages of `docs`, and how many outputs each shows at least."""


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
def test_every_example_prints_what_stands_below_it(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    names: dict[str, Any] = {"Path": Path}
    reader, printed, compared = Reader(monkeypatch), io.StringIO(), 0
    for block in blocks(ROOT / "docs" / f"{page}.md"):
        if block.language == "python":
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(block.text, page, "exec"), names)  # what the page shows is to be run
        elif block.language == "text":
            compared += 1
            if block.words == "lines":
                reader.compare(block.text)
            else:
                assert printed.getvalue() == block.text
        elif block.language == "sh":
            reader.type(block)
            printed = io.StringIO(reader.printed)
        elif block.words:
            Path(block.words).write_text(block.text, "utf-8")
    assert compared >= PAGES[page]
