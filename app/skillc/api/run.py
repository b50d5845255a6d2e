"""A run that has ended, or one that was recorded: result, events, explanations, figures and frames."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import msgspec

from skillc.api.boundary import NoticeList, api_call
from skillc.api.picture import Figure, Film
from skillc.errors import RequestError, ServiceError
from skillc.services.recording.recordings import (
    answer_question,
    find_mcap,
    find_recording,
    is_mcap,
    read_envelopes,
    read_result,
    read_signals,
)
from skillc.services.recording.story_text import format_answer, format_overview
from skillc.services.replaying.playback import play_paced
from skillc.services.run.signal_files import read_signal_dictionary
from skillc.values.arguments import AnyPath, require_choice, require_path, require_text
from skillc.values.flat_rows import make_flat_row
from skillc.values.frames import import_pandas, make_frame, make_table
from skillc_runtime.evaluation.report.result import (
    REPORT,
    PlacementResult,
    StepResult,
    TaskResult,
    WipingResult,
    WorkResult,
)
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.history.history_builder import read_history
from skillc_runtime.recording.known_facts import format_false_claim
from skillc_runtime.recording.signals.files import DICTIONARY
from skillc_runtime.recording.signals.signal import CLOCK
from skillc_runtime.world.state.labels.labelled_text import format_value

if TYPE_CHECKING:
    import pandas as pd
if TYPE_CHECKING:
    import pandas as pd


def read_signal_frame(folder: Path | None, recording: Path | None) -> pd.DataFrame:
    """Return the signals that were recorded in a folder, by the time of the cell in s, with their units in `attrs`.

    Without them it is the signals of a recording, an MCAP file. RequestError if there are none; ServiceError if they
    cannot be read, or pandas is not installed.
    """
    if recording is not None and (folder is None or not (folder / DICTIONARY).exists()):
        table, pandas = read_signals(recording), import_pandas()
        index = pandas.Index(table.time_s, name=CLOCK.column)
        frame = pandas.DataFrame(table.rows, index, [each.column for each in table.signals])
        frame.attrs["units"] = {each.column: each.unit for each in table.signals}
        return frame
    dictionary = read_signal_dictionary(folder)
    assert folder is not None, "a folder with signals"
    file, pandas = folder / dictionary.file, import_pandas()
    try:
        frame = pandas.read_parquet(file) if file.suffix == ".parquet" else pandas.read_csv(file)
    except (OSError, ValueError, ImportError) as error:
        raise ServiceError(f"{file} cannot be read: {error}") from error
    frame.attrs["units"] = {each.column: each.unit for each in dictionary.signals}
    return frame.set_index(CLOCK.column)


Part = Literal["events", "steps", "signals", "wipings", "works", "placements", "touches"]
STEP_COLUMNS = (
    "step", "skill", "implementation", "arguments", "rounds", "status", "start_s", "end_s", "failure",
)  # fmt: skip
EVENT_COLUMNS = ("sequence", "time_s", "type", "name", "status", "message")


@dataclass(frozen=True, slots=True)
class Run:
    """A run that has ended; `folder` is where it was recorded, None for nowhere. Notebooks show its summary.

    `recording` is its MCAP file, None if there is none.
    """

    result: TaskResult
    events: tuple[Envelope, ...] = field(repr=False, default=())
    folder: Path | None = None
    messages: tuple[str, ...] = ()
    recording: Path | None = None

    @property
    def task(self) -> str:
        """The name of the task, or the text of the goal or call."""
        return self.result.task

    @property
    def status(self) -> str:
        """How it ended: succeeded, failed, stopped, interrupted, or refused if it did not start."""
        return self.result.status

    @property
    def succeeded(self) -> bool:
        """Whether the task succeeded, and the simulator contradicts nothing that the world model claims at its end."""
        return self.result.is_sound

    @property
    def verified(self) -> bool | None:
        """Whether a success rests on no assumption, and no claim is false; None if the task did not succeed."""
        return self.result.verified

    @property
    def false_claims(self) -> tuple[str, ...]:
        """What the world model claims of things at the end that is not so in the simulator, a sentence each."""
        return self.result.false_claims

    @property
    def failure(self) -> str | None:
        """Why the task did not succeed, as a sentence; None if it did."""
        return self.result.failure

    @property
    def steps(self) -> tuple[StepResult, ...]:
        """The steps of its last plan, or of its body."""
        return self.result.plan

    @property
    def measures(self) -> tuple[WipingResult | WorkResult | PlacementResult, ...]:
        """The numbers of each piece of work: wipings, then other work, then where the things are that it moved."""
        return (*self.result.wipings, *self.result.works, *self.result.placements)

    @property
    def figures(self) -> tuple[Figure, ...]:
        """The figures of its report; none without a folder."""
        if self.folder is None:
            return ()
        return tuple(Figure(path) for path in sorted(self.folder.glob("*.png")) if path.with_suffix(".svg").exists())

    @property
    def film(self) -> Film | None:
        """Its film; None if there is none: without a folder or a GL library nothing is filmed."""
        from skillc_runtime.film.footage import FILM

        path = None if self.folder is None else self.folder / FILM
        return Film(path) if path is not None and path.exists() else None

    @property
    def report(self) -> Path | None:
        """Its report, a page in HTML; None if there is none."""
        path = None if self.folder is None else self.folder / REPORT
        return path if path is not None and path.exists() else None

    def why(self, question: str | None = None) -> str:
        """Explain the run, or what a question is about, as `skillc why` does.

        A question is the number of a step (`2`, `2.1`), a skill, an implementation, or a parameter (`Pick.gripper`).
        RequestError for a question about something that is not in the run.
        """
        with api_call():
            history = read_history(each.event for each in self.events)
            if history is None:
                raise ServiceError(f"the run of {self.task} has no events: {self.failure or 'it did not begin'}")
            if question is None:
                return format_overview(history, str(self.folder or "RUN"))
            return format_answer(answer_question(history, require_text(question, "the question")))

    def replay(self, pace: float = 1.0) -> Iterator[Envelope]:
        """Yield its events in the time of its cell, `pace` times as fast as it went; nothing is computed.

        RequestError for a pace that is not positive, SkillcError if the run has no events.
        """
        if not pace > 0.0:
            raise RequestError(f"the pace of a replay is positive, not {pace:g}")
        with api_call():
            return play_paced(self.events, pace)

    def to_dict(self) -> dict[str, Any]:
        """Return its result as plain data, as in `result.json`."""
        value: dict[str, Any] = msgspec.to_builtins(self.result)
        return value

    def to_frame(self, part: Part = "events") -> pd.DataFrame:
        """Return a part as a pandas frame with a row for each event, step, sample of signals, or piece of work.

        `signals` are those that `signals=` recorded, else those of each control period in `recording`, with the time
        in s as index; `frame.attrs["units"]` has the units of the columns. Cells are numbers and texts; what was not
        measured is missing. SkillcError if pandas is not installed,
        RequestError if no signals were recorded.
        """
        require_choice(part, Part, "the part")
        if part == "events":
            return make_frame(map(_event_row, self.events), EVENT_COLUMNS)
        if part == "steps":
            return make_frame([dict(zip(STEP_COLUMNS, row, strict=True)) for row in self._step_rows()], STEP_COLUMNS)
        if part == "signals":
            with api_call():
                return read_signal_frame(self.folder, self.recording)
        values: Sequence[msgspec.Struct] = getattr(self.result, part)
        return make_frame(map(make_flat_row, values))

    def _step_rows(self) -> list[tuple[object, ...]]:
        return [
            (
                int(each.number), each.skill, each.implementation, _arguments(each.arguments),
                ", ".join(map(str, each.rounds)), each.status, each.start_s, each.end_s, each.failure,
            )
            for each in self.steps
        ]  # fmt: skip

    def _repr_html_(self) -> str:
        known = {None: "", True: ", verified", False: ", not verified"}[self.verified]
        head = f"<p><b>{escape(self.task)}</b>: {self.status}{known}, {self.result.sim_time_s:.1f} s"
        sentences = (*map(format_false_claim, self.false_claims), *filter(None, (self.failure,)))
        why = "".join(f"<br>{escape(each)}" for each in sentences)
        table = make_table(STEP_COLUMNS, self._step_rows()) if self.steps else ""
        pictures = "".join(path.with_suffix(".svg").read_text("utf-8") for path in (each.path for each in self.figures))
        return f"{head}{why}</p>{table}{pictures}"


def open_run(path: AnyPath) -> Run:
    """Return the run that was recorded in a folder, in an MCAP file, or in a file of events.

    SkillcError if there is no readable recording.
    """
    with api_call():
        folder = require_path(path, "the folder of a run")
        notes = NoticeList()
        file = find_recording(folder)
        events = read_envelopes(file, notes)
        recording = file if is_mcap(file) else find_mcap(file.parent)
        return Run(read_result(file, events), events, file.parent, tuple(notes.messages), recording)


def _arguments(arguments: Mapping[str, Any]) -> str:
    return ", ".join(f"{name}: {format_value(value)}" for name, value in arguments.items())


def _event_row(envelope: Envelope) -> dict[str, object]:
    event = envelope.event
    failure = getattr(event, "failure", None)
    message = getattr(event, "message", None) or getattr(failure, "message", None)
    name = getattr(event, "name", None) or getattr(event, "skill", None) or getattr(event, "origin", None)
    return {
        "sequence": envelope.sequence,
        "time_s": event.time,
        "type": str(event.__struct_config__.tag),
        "name": name or getattr(event, "task", None),
        "status": getattr(event, "status", None) or getattr(event, "state", None),
        "message": message or getattr(event, "reason", None),
    }
