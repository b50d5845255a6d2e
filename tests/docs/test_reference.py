"""The language reference leaves nothing out, links lead somewhere, and the list of diagnostics is the manual's."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from docs.manual import MANUAL, manual
from docs.pages import ROOT, blocks
from skillc_compiler.manual import load_pages
from skillc_dsl.descriptions.members import FLAGS
from skillc_dsl.descriptions.nodes import DECORATORS
from skillc_dsl.parsing.grammar import fixed_texts
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.source import Source
from skillc_model.format_type import SI_UNITS

REFERENCE = ROOT / "docs/language.md"
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def tokens() -> set[tuple[str, str]]:
    """Return the kinds and texts of all tokens in the examples of the language reference, and in the forms of nodes."""
    texts = [block.text for block in blocks(REFERENCE) if block.language == "skill"]
    texts += [*(each.written for each in DECORATORS), *(each.keyword for each in FLAGS)]
    return {(token.type, str(token)) for text in texts for token in tokenize(Source("example", text)).value}


def test_every_word_and_sign_of_the_language_is_in_an_example() -> None:
    expected = set(fixed_texts().items())
    assert len(expected) > 80
    assert expected - tokens() == set()


def test_every_dimension_is_named() -> None:
    text = REFERENCE.read_text(encoding="utf-8")
    assert len(SI_UNITS) > 10
    assert {dimension for dimension in SI_UNITS if f"`{dimension}`" not in text} == set()


def test_the_list_of_diagnostics_is_the_manual() -> None:
    assert MANUAL.read_text(encoding="utf-8") == manual(), "make accept"
    assert len(load_pages()) > 50


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert links
    for link in links:
        target, _, place = link.partition("#")
        if "://" in link:
            continue
        file = (page.parent / target).resolve() if target else page
        assert file.exists(), link
        assert not place or place in _anchors(file.read_text(encoding="utf-8")), link


def _anchors(text: str) -> set[str]:
    """Return the places that a code host makes of the headings."""
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in re.findall(r"^#+ (.*)$", text, re.M)
    }
