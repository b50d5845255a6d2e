"""The glossary is sorted, has each term once, and names types that exist."""

from __future__ import annotations

import re

from docs.pages import ROOT

ENTRY = re.compile(r"^- \*\*(.+?)\*\*: (.+?)(?=^- |\Z)", re.MULTILINE | re.DOTALL)
ENTRIES = [(entry[1], " ".join(entry[2].split())) for entry in ENTRY.finditer((ROOT / "docs/glossary.md").read_text())]
PACKAGES = ("dsl", "ontology", "compiler", "runtime", "app")


def test_terms_are_sorted_and_unique() -> None:
    terms = [term.casefold() for term, _ in ENTRIES]
    assert len(terms) > 100
    assert terms == sorted(set(terms))


def test_definitions_are_one_to_three_sentences() -> None:
    for term, text in ENTRIES:
        assert text.endswith("."), term
        assert 1 <= len(re.findall(r"\.(?= |$)", text.partition(" Type: ")[0])) <= 3, term


def test_types_exist() -> None:
    defined = re.compile(r"^(?:class (\w+)|(\w+): TypeAlias)", re.MULTILINE)
    code = "\n".join(path.read_text("utf-8") for package in PACKAGES for path in (ROOT / package).rglob("*.py"))
    names = {one or other for one, other in defined.findall(code)}
    types = [name for _, text in ENTRIES for name in re.findall(r"Type: `(\w+)`\.$", text)]
    assert len(types) > 50
    assert set(types) <= names
