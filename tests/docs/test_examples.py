"""Every skill example in the documentation compiles."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_compiler import pipeline
from skillc_dsl.formatting.formatter import check_layout
from skillc_dsl.rendering.concise import render
from skillc_dsl.source import Source

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```skill\n(.*?)^```", re.MULTILINE | re.DOTALL)
EXAMPLES = [
    pytest.param(text, id=f"{page.name}-{number}")
    for page in PAGES
    for number, text in enumerate(BLOCK.findall(page.read_text(encoding="utf-8")), 1)
]


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 6


@pytest.mark.parametrize("text", EXAMPLES)
def test_example_is_laid_out_as_the_formatter_does(text: str) -> None:
    assert check_layout(Source("example.skill", text)) is None


@pytest.mark.parametrize("text", EXAMPLES)
def test_example_compiles(text: str) -> None:
    shelf = find_library(SHIPPED / "wiping")
    neighbours = shelf.importable | {source.path: source for source in shelf.sources}
    outcome = pipeline.compile([Source("example.skill", text)], libraries.load_vocabulary(), neighbours, "example")
    unexpected = [each for each in outcome.diagnostics if each.name != "no-implementation"]
    assert not unexpected, render(unexpected, {})
