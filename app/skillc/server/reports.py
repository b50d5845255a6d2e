"""The reports of operations: each is made by running the operation again from its recording."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skillc.contract.jobs import MakeReport
from skillc.contract.report import REPORT_TYPES, OperationReport
from skillc.server.simulation_jobs import SimulationJobs


@dataclass(frozen=True, slots=True)
class Reports:
    """The reports among the jobs of a server."""

    jobs: SimulationJobs

    def begin(self, operation: str, recording: Path, film: bool, snapshot: bytes) -> OperationReport:
        """Make the report of an operation from its recording; `snapshot` has the library of its cell, encoded."""
        self.jobs.begin(_name(operation), lambda folder: MakeReport(str(recording), str(folder), film), snapshot)
        return OperationReport(operation=operation)

    def find(self, operation: str) -> OperationReport | None:
        """Return the report of an operation; None if none was requested, or it is forgotten."""
        outcome = self.jobs.find(_name(operation))
        if outcome is None:
            return None
        return OperationReport(
            operation=operation,
            state="ended" if outcome.ended else "going on",
            reason=outcome.reason,
            result=outcome.result,
            files=tuple(each for each in outcome.files if Path(each).suffix in REPORT_TYPES),
        )

    def find_file(self, operation: str, file: str) -> Path | None:
        """Return a file of a report; None if it has none of this name."""
        return self.jobs.find_file(_name(operation), file) if Path(file).suffix in REPORT_TYPES else None

    def remove(self, operation: str) -> None:
        """End and forget a report."""
        self.jobs.remove(_name(operation))


def _name(operation: str) -> str:
    return f"report-{operation}"
