"""Formats the differences between two runs for people."""

from __future__ import annotations

from itertools import groupby

from skillc.cli.layout import Row, TableCell, TerminalPage
from skillc.contract.runs.run_diff import Difference, Leaf, RunDiff

SHOWN = 6
"""How many differences of a part are shown."""


def format_diff(diff: RunDiff, page: TerminalPage) -> list[str]:
    """Return the differences as lines: a table of each part, in the order in which one may cause another."""
    if not diff.differences:
        return page.wrap(f"no difference in {_describe_compared(diff)}")
    rows: list[Row] = []
    for part, group in groupby(diff.differences, lambda each: each.part):
        found = list(group)
        rows += [_row(part if not number else "", each) for number, each in enumerate(found[:SHOWN])]
        if len(found) > SHOWN:
            rows.append(("", f"and {len(found) - SHOWN} more", "", ""))
    return page.table(("", "", *diff.runs), rows)


def _describe_compared(diff: RunDiff) -> str:
    parts = (f"{part} ({count})" for part, count in diff.compared.items() if count)
    return ", ".join(parts)


def _row(part: str, each: Difference) -> Row:
    return TableCell(part, "strong"), each.what, _format(each.first), _format(each.second)


def _format(value: Leaf) -> str:
    match value:
        case None:
            return "-"
        case bool():
            return "yes" if value else "no"
        case float():
            return f"{value:.5g}"
        case _:
            return str(value)
