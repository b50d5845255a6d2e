"""Records as pandas frames and as HTML tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from skillc.extras import naming_extras

if TYPE_CHECKING:
    import pandas as pd

SHOWN_ROWS = 30
"""How many rows a table shows in a notebook."""


def make_frame(rows: Iterable[Mapping[str, Any]], columns: Sequence[str] | None = None) -> pd.DataFrame:
    """Return records as a frame. MissingExtraError if pandas is not installed."""
    return import_pandas().DataFrame(list(rows), columns=None if columns is None else list(columns))


def import_pandas() -> Any:
    """Return pandas. MissingExtraError if it is not installed."""
    with naming_extras():
        import pandas as pd
    return pd


def make_table(columns: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return an HTML table of texts; the number of rows that it leaves out is written below it."""
    head = "".join(f"<th>{escape(each)}</th>" for each in columns)
    body = "".join(_row(each) for each in rows[:SHOWN_ROWS])
    more = f"<p>and {len(rows) - SHOWN_ROWS} more rows</p>" if len(rows) > SHOWN_ROWS else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _row(cells: Sequence[object]) -> str:
    return "<tr>" + "".join(f"<td>{escape('' if each is None else str(each))}</td>" for each in cells) + "</tr>"
