"""The answer to a query, as rows of plain values."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from skillc.values.frames import make_frame, make_table
from skillc_runtime.scene.query import QueryValue

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, slots=True)
class QueryResult:
    """Rows of values under the names of columns; individuals are short names, None is an unbound variable."""

    columns: tuple[str, ...]
    rows: tuple[tuple[QueryValue, ...], ...]

    def __iter__(self) -> Iterator[tuple[QueryValue, ...]]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def to_dicts(self) -> list[dict[str, QueryValue]]:
        """Return each row as values by column."""
        return [dict(zip(self.columns, row, strict=True)) for row in self.rows]

    def to_frame(self) -> pd.DataFrame:
        """Return it as a pandas frame. SkillcError if pandas is not installed."""
        return make_frame(self.to_dicts(), self.columns)

    def _repr_html_(self) -> str:
        return make_table(self.columns, self.rows)
