"""Whoever follows what messages offer comes to an end: no fix brings back what another one took away."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_error_cases import CASES, diagnostics_of

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.edits import apply_fixes, drop_overlapping

MOST_ROUNDS = 8
PROVED = ("child-precondition", "post-not-established", "undeclared-effect", "unlinked-inference", "always-true")
"""What is said of the conditions and the body of a skill."""


def errors(found: list[Diagnostic]) -> int:
    """Return the number of errors."""
    return sum(each.severity == "error" for each in found)


def times(problem: Diagnostic, found: list[Diagnostic]) -> int:
    """Return how often the same is said, wherever it is."""
    return sum((each.name, each.message) == (problem.name, problem.message) for each in found)


@pytest.mark.slow
@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_following_all_fixes_comes_to_an_end(path: Path) -> None:
    text = path.read_text()
    first = found = diagnostics_of(path, text)
    seen = {text}
    for _ in range(MOST_ROUNDS):
        fixes = list(drop_overlapping(each.fix for each in found if each.fix is not None))
        if not fixes:
            break
        text = apply_fixes(text, fixes)
        assert text not in seen, "fixes undo each other"
        seen.add(text)
        found = diagnostics_of(path, text)
    assert errors(found) < errors(first) or len(seen) == 1 or not errors(first)
    assert not [each.fix for each in found if each.fix is not None], "fixes that lead to further fixes, for ever"


def test_each_fix_of_a_condition_removes_more_than_it_brings() -> None:
    tried = 0
    for path in (each for each in CASES if each.stem in ("proof", "wrapping")):
        before = diagnostics_of(path, path.read_text())
        for one in (each for each in before if each.fix is not None and each.name in PROVED):
            assert one.fix is not None
            after = diagnostics_of(path, apply_fixes(path.read_text(), [one.fix]))
            assert times(one, after) < times(one, before), one
            assert errors(after) <= errors(before), one
            assert sum(each.name in PROVED for each in after) < sum(each.name in PROVED for each in before), one
            tried += 1
    assert tried >= 3
