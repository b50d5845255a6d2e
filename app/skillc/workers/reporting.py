"""Makes the report of an operation from its recording."""

from __future__ import annotations

from pathlib import Path

from skillc.cells.snapshot import CellSnapshot
from skillc.contract.jobs import MakeReport
from skillc.errors import RequestError
from skillc.services.replaying.report import report_recorded
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.recording.run_spec import RunSpec


def make_report(job: MakeReport, known: CellSnapshot) -> TaskResult:
    """Write the report to the folder of the job, and return the result; ServiceError if it cannot be made."""
    spec = RunSpec(out=job.folder, film=job.film)
    made = report_recorded(Path(job.recording), known.library, spec, SilentReporter())
    if not made.written:
        raise RequestError("the report cannot be written")
    return made.result
