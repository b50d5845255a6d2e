"""Makes the report of a recorded run: it is run again from its inputs, with what the report samples."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from skillc.errors import ServiceError
from skillc.services.recording.picture_making import ShowProgress, making_pictures, no_progress
from skillc.services.replaying.check import build_cell, repeat
from skillc.services.replaying.inputs import read_inputs
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.result import ReportDestination, ReportedRun, begin_film, check_film, make_samples, report_run
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.execute import describe_execution
from skillc_runtime.execution.repeat import NotRepeatable
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.recording.run_spec import RunSpec


def report_recorded(
    run: Path, library: Path | SkillLibrary | None, spec: RunSpec, reporter: Reporter, show: ShowProgress = no_progress
) -> ReportedRun:
    """Write the report, the figures and the film of a recorded run to the folder `out` of a specification.

    The film has the options of the request, and `show` gets its progress. Returns once the film is done.
    ServiceError if it cannot be repeated, or has no end; what `read_inputs` and `check_film` raise.
    """
    assert spec.out is not None, "a report has a folder"
    check_film(spec)
    out = Path(spec.out)
    inputs = read_inputs(run, library, reporter)
    if inputs.obstacle:
        raise ServiceError(f"no report can be made of {run}: {inputs.obstacle}, so it cannot be repeated")
    reporter.say(f"running {inputs.start.task} again from its seed, requests and plans")
    with making_pictures(reporter, show) as pictures, closing(build_cell(inputs)) as cell:
        samples, builder = make_samples(cell, begin_film(cell, spec, reporter)), HistoryBuilder()
        try:
            repeated = repeat(inputs, cell, (builder,), (samples.sample,))
        except NotRepeatable as error:
            raise ServiceError(f"no report can be made: {error}") from error
        if repeated.difference is not None:
            number = repeated.difference.number
            found = f"its event {number} is another one when it is repeated; `skillc replay {run} --check` shows it"
            raise ServiceError(f"no report can be made of {run}: {found}")
        if repeated.run is None or not repeated.ended:
            raise ServiceError(f"no report can be made of {run}: the recording ends before the run")
        with writing_to(out):
            out.mkdir(parents=True, exist_ok=True)
        execution = describe_execution(repeated.run, cell, inputs.wall_time_s)
        return report_run(execution, builder, inputs.library, samples, ReportDestination(out, pictures, reporter))
