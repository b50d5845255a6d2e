"""Makes the report of a recorded run: it is run again from its inputs, with what the report samples."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from skillc.errors import ServiceError
from skillc.services.files import writing_to
from skillc.services.replaying.check import build_cell, repeat
from skillc.services.replaying.inputs import read_inputs
from skillc.services.reporting import Reporter
from skillc.services.run_result import PRIMITIVE_LOOKS, RunResult, begin_film, check_film, make_samples, report_run
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.execute import describe_execution
from skillc_runtime.execution.repeat import NotRepeatable
from skillc_runtime.recording.history_builder import HistoryBuilder


def report_recorded(
    run: Path,
    out: Path,
    library: Path | SkillLibrary | None,
    reporter: Reporter,
    looks: str = PRIMITIVE_LOOKS,
    film: bool = True,
    gif: bool = False,
) -> RunResult:
    """Write the report, the figures and the film of a recorded run to a folder, and return its result.

    The film shows the meshes of `looks`; with `gif` there is one that repeats, too.

    ServiceError if it cannot be repeated, or has no end; what `read_inputs` and `check_film` raise.
    """
    check_film(looks, film, gif)
    inputs = read_inputs(run, library, reporter)
    if inputs.obstacle:
        raise ServiceError(f"no report can be made of {run}: {inputs.obstacle}, so it cannot be repeated")
    reporter.say(f"running {inputs.start.task} again from its seed, requests and plans")
    with closing(build_cell(inputs)) as cell:
        filming = begin_film(cell, looks, gif, reporter) if film else None
        samples, builder = make_samples(cell, filming), HistoryBuilder()
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
        return report_run(execution, builder, inputs.library, samples, out, reporter)
