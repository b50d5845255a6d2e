"""The trials of a task, judged, as Python programs get them."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

import msgspec

from skillc.values.flat_rows import Cell, make_flat_row
from skillc.values.frames import make_frame, make_table
from skillc_runtime.evaluation.trials.series import Series, Spread
from skillc_runtime.evaluation.trials.trial import Trial

if TYPE_CHECKING:
    import pandas as pd

SPREAD_COLUMNS = ("metric", "subject", "unit", "target", "least", "median", "greatest", "met")


@dataclass(frozen=True, slots=True)
class Trials:
    """The trials of a task, judged; notebooks show the spread of each metric."""

    series: Series

    @property
    def passed(self) -> int:
        """How many trials met all criteria."""
        return self.series.passed

    @property
    def is_good(self) -> bool:
        """Whether all trials passed and all medians meet their targets."""
        return self.series.is_good

    @property
    def trials(self) -> tuple[Trial, ...]:
        """The trials, in the order of their seeds."""
        return self.series.trials

    @property
    def spreads(self) -> tuple[Spread, ...]:
        """The spread of each metric of each thing over the trials."""
        return self.series.spreads

    def to_dict(self) -> dict[str, Any]:
        """Return them as plain data, as `skillc trials --json` prints them."""
        value: dict[str, Any] = msgspec.to_builtins(self.series)
        return value

    def to_frame(self) -> pd.DataFrame:
        """Return a pandas frame with a row for each trial. SkillcError if pandas is not installed.

        What was measured of each thing has columns of its own, such as `lab:Table-1.coverage`; what was not measured is
        missing.
        """
        return make_frame(map(_make_row, self.trials))

    def _repr_html_(self) -> str:
        series = self.series
        rows = [[getattr(each, name) for name in SPREAD_COLUMNS] for each in self.spreads]
        head = f"<p><b>{escape(series.task)}</b>: {series.passed} of {series.wanted} trials passed</p>"
        return f"{head}{make_table(SPREAD_COLUMNS, rows) if rows else ''}"


def _make_row(trial: Trial) -> dict[str, Cell]:
    """Return the fields of a trial as cells, and those of each piece of work after the name of its thing."""
    row = {name: cell for name, cell in make_flat_row(trial).items() if name != "works"}
    for work in trial.works:
        _, (_, thing), *measured = make_flat_row(work).items()
        row |= {f"{thing}.{name}": cell for name, cell in measured}
    return row
