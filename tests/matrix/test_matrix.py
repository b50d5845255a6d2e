"""Every feature of the language means the same in each artifact, or is refused by name."""

from __future__ import annotations

import pytest

from emit.reasoner import classified, needs_java
from matrix.case import Case, cases
from matrix.measured import measured
from matrix.table import PAGE, page
from skillc_compiler.emit import owl


@pytest.mark.slow
@pytest.mark.parametrize("case", cases(), ids=lambda case: case.name)
def test_a_feature_becomes_what_is_expected(case: Case) -> None:
    found = measured(case)
    assert {word: found[word] for word in case.expected} == case.expected
    assert set(found) - {"json"} <= set(case.expected)


@pytest.mark.reasoner
@needs_java
def test_a_reasoner_finds_the_vocabularies_consistent() -> None:
    axioms = [case.library()[0] for case in cases() if case.name.startswith("vocabulary_")]
    assert len(axioms) > 1
    world = classified(owl.emit(each)["skills.ttl"] for each in axioms)
    assert list(world.inconsistent_classes()) == []


def test_the_page_of_the_documentation_is_the_table() -> None:
    assert PAGE.read_text() == page()
