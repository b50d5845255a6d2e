"""How much of a library its tests cover, in numbers, and the lines that they do not."""

from __future__ import annotations

import msgspec

from skillc.services.testing.coverage import ITEM_NAMES, KINDS, Coverage, CoverageItem
from skillc.services.testing.suite import TestSuite


class CoveredCount(msgspec.Struct, frozen=True):
    """How many of `total` things are `covered`."""

    covered: int
    total: int


class CoverageReport(msgspec.Struct, frozen=True):
    """What the tests of a library cover, by kind (skills, implementations, nodes, conditions), and what they do not.

    `uncovered` has the lines with something that is not covered, by file; `half` those of them with a condition of an
    `if`, `while` or `check` that was only true, or only false.
    """

    library: str
    counts: dict[str, CoveredCount]
    uncovered: dict[str, tuple[int, ...]]
    half: dict[str, tuple[int, ...]]


def report_coverage(suite: TestSuite, coverage: Coverage) -> CoverageReport:
    """Return what was covered of a library."""
    covered, missing = coverage.covered, coverage.items - coverage.covered
    counts = {ITEM_NAMES[kind]: CoveredCount(_count(covered, kind), _count(coverage.items, kind)) for kind in KINDS}
    half = {each for each in missing if each.outcome is not None and _opposite(each) in covered}
    return CoverageReport(suite.library.name, counts, _lines(suite, missing - half), _lines(suite, half))


def format_lines(lines: tuple[int, ...]) -> str:
    """Return lines as ranges, such as `3, 7-9`."""
    ranges: list[list[int]] = []
    for line in lines:
        if ranges and line == ranges[-1][1] + 1:
            ranges[-1][1] = line
        else:
            ranges.append([line, line])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)


def _count(items: frozenset[CoverageItem], kind: str) -> int:
    return sum(each.kind == kind for each in items)


def _opposite(item: CoverageItem) -> CoverageItem:
    return CoverageItem(item.kind, item.source, not item.outcome)


def _lines(suite: TestSuite, items: set[CoverageItem] | frozenset[CoverageItem]) -> dict[str, tuple[int, ...]]:
    found: dict[str, set[int]] = {}
    for each in items:
        found.setdefault(suite.files.display_path(each.source.path), set()).add(each.source.line)
    return {path: tuple(sorted(lines)) for path, lines in sorted(found.items())}
