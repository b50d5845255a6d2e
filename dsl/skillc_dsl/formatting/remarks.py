"""Comments at the ends of lines: in one column for lines that stand together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_dsl.formatting.layout import WIDTH, Row

GAP = 2


def text_of(rows: Sequence[Row]) -> str:
    """Return the text of all rows, each with its comment."""
    return "".join(line for run in _runs(rows) for line in _lines(run))


def _runs(rows: Sequence[Row]) -> Iterator[list[Row]]:
    """Yield the rows up to a blank line or another indentation."""
    run: list[Row] = []
    for row in rows:
        if run and (row.blank_before or row.indent != run[-1].indent):
            yield run
            run = []
        run.append(row)
    yield run


def _lines(run: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a run; where a comment would then be too long, each stands `GAP` columns from its line."""
    column = GAP + max((row.width for row in run if row.remark), default=0)
    aligned = all(column + len(row.remark) <= WIDTH for row in run)
    for row in run:
        blank = "\n" if row.blank_before else ""
        code = (" " * row.indent + row.code).rstrip()
        start = column if aligned else row.width + GAP
        yield f"{blank}{code:<{start}}{row.remark}\n" if row.remark else f"{blank}{code}\n"
