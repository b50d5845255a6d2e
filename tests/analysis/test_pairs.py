"""Pairs of compounds, `right` and `wrong`: what is wrong is found where it is marked, and nothing else is."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source

FILES = sorted((Path(__file__).parent / "pairs").glob("*.skill"))
KINDS = [path.stem for path in FILES if path.stem != "things"]
MARK = re.compile(r'#! ([a-z-]+) "([^"]*)"')


@cache
def told() -> dict[tuple[str, int], list[tuple[str, str]]]:
    """Return name and words of all diagnostics in all pairs, by file and line."""
    sources = [Source(path.name, path.read_text()) for path in FILES]
    found: dict[tuple[str, int], list[tuple[str, str]]] = {}
    for each in compile(sources, vocabulary(), shelf(), "pairs").diagnostics:
        words = " | ".join((each.message, each.help or "", *(label.message for label in each.labels)))
        found.setdefault((each.span.path, each.span.line), []).append((each.name, words))
    return found


def differences(kind: str) -> list[str]:
    """Return what is told and not marked in the pairs of a kind, and what is marked and not told."""
    lines = FILES[0].with_stem(kind).read_text().split("\n")
    found: list[str] = []
    for number, line in enumerate(lines, 1):
        marks = MARK.findall(line)
        given = told().get((f"{kind}.skill", number), [])
        found += [f"{kind}:{number} tells {each}" for each in given if not any(_fits(m, each) for m in marks)]
        found += [f"{kind}:{number} misses {m}" for m in marks if not any(_fits(m, each) for each in given)]
    return found


def _fits(mark: tuple[str, str], given: tuple[str, str]) -> bool:
    return mark[0] == given[0] and mark[1] in given[1]


def test_the_pairs_are_whole() -> None:
    texts = [path.read_text() for path in FILES if path.stem != "things"]
    parts = [part for text in texts for part in re.split(r"^(?=impl )", text, flags=re.MULTILINE)]
    right, wrong = ([part for part in parts if part.startswith(f"impl {name} of")] for name in ("right", "wrong"))
    assert len(right) == len(wrong) == 10 * len(KINDS)
    assert not any(MARK.search(part.split("\n}\n")[0]) for part in right)
    assert all(MARK.search(part.split("\n}\n")[0]) for part in wrong)


@pytest.mark.parametrize("kind", KINDS)
def test_bugs_are_found_and_nothing_else(kind: str) -> None:
    assert differences(kind) == []
    assert {key for key in told() if key[0] == "things.skill"} == set()
