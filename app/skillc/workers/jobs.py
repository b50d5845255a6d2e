"""What a worker can be asked about a snapshot of a cell, and what it answers."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc.services.diagnosis import NO_DIAGNOSIS, Diagnosis
from skillc_runtime.evaluation.trials.trial import Disturbance
from skillc_runtime.world.state.evidence import Evidence
from skillc_runtime.world.state.labelled import LabelledChange, LabelledFact


class QueryWorld(msgspec.Struct, frozen=True, tag="query"):
    """Answer a SPARQL query over the facts, the data sheets and the vocabulary."""

    sparql: str


class ListFacts(msgspec.Struct, frozen=True, tag="facts"):
    """List the stated facts about the individuals of a class, or about one, but not those of data sheets.

    Names are IRIs or `prefix:name`; None stands for all. With `words`, those whose names, labels, classes or texts
    contain them.
    """

    subject: str | None
    cls: str | None
    words: str | None
    offset: int
    limit: int


WorldFormat: TypeAlias = Literal["turtle", "rdfxml", "jsonld", "ntriples", "trig", "graph", "top-view"]
"""The forms of RDF, and pictures as SVG: the individuals with their relations, and what is where from above."""


class WriteWorld(msgspec.Struct, frozen=True, tag="write-world"):
    """Write the world of the cell of a name in a format; RDF with the facts of data sheets if `everything`."""

    cell: str
    format: WorldFormat
    everything: bool


class ListThings(msgspec.Struct, frozen=True, tag="things"):
    """List the things that have a pose of their own or a size."""


class ListWrites(msgspec.Struct, frozen=True, tag="writes"):
    """List the last writes before a number, the last one first, from the journal of the cell."""

    journal: str
    before: int
    limit: int


class DescribeLibrary(msgspec.Struct, frozen=True, tag="library"):
    """Describe the library of the cell."""


class ListDevices(msgspec.Struct, frozen=True, tag="devices"):
    """List the devices of the cell."""


class ListPoses(msgspec.Struct, frozen=True, tag="poses"):
    """List where the individuals of the cell are in the world, but not those of data sheets."""


class CheckOperation(msgspec.Struct, frozen=True, tag="check"):
    """Check that an operation could be submitted now; its values are those of an OperationRequest."""

    task: str | None
    goal: str | None
    call: str | None
    arguments: dict[str, str]
    breakpoints: tuple[str, ...]


class PreviewPlan(msgspec.Struct, frozen=True, tag="plan"):
    """Plan for a task with arguments, or for a goal; the search ends after `deadline_s` s."""

    task: str | None
    goal: str | None
    arguments: dict[str, str]
    measure: Measure
    deadline_s: float


class Rehearse(msgspec.Struct, frozen=True, tag="rehearse"):
    """Do in a simulated twin of the cell what an operation would; what it wants of it is written to a folder."""

    request: RehearsalRequest
    folder: str


class MakeReport(msgspec.Struct, frozen=True, tag="report"):
    """Write the report of the operation that is recorded in a file to a folder, with a film or without."""

    recording: str
    folder: str
    film: bool = True


class CheckTrials(msgspec.Struct, frozen=True, tag="check trials"):
    """Check that trials can be run from the file of a scene."""

    request: TrialsRequest
    scene: str


class RunTrial(msgspec.Struct, frozen=True, tag="trial"):
    """Run the trial of a seed from the file of a scene; None for the seed only loads and plans."""

    request: TrialsRequest
    scene: str
    seed: int | None


class RecordTrial(msgspec.Struct, frozen=True, tag="record trial"):
    """Run the trial of a seed from the file of a scene again, and record it in a folder."""

    request: TrialsRequest
    scene: str
    seed: int
    folder: str


Question: TypeAlias = (
    QueryWorld
    | ListFacts
    | WriteWorld
    | ListThings
    | ListWrites
    | DescribeLibrary
    | ListDevices
    | ListPoses
    | CheckOperation
    | PreviewPlan
)
SimulationJob: TypeAlias = Rehearse | MakeReport | CheckTrials | RunTrial | RecordTrial
Job: TypeAlias = Question | SimulationJob


class JobRefused(msgspec.Struct, frozen=True):
    """Why a job cannot be done; `why` is empty if a `diagnosis` says more."""

    why: str = ""
    diagnosis: Diagnosis = NO_DIAGNOSIS


class RehearsalRequest(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, forbid_unknown_fields=True):
    """A task of the cell's library with arguments, a goal, or a call of a skill, to try in a simulated twin.

    `seed` determines how the reality of the twin differs from the facts. `deadline_s` is in the twin's time. It is
    filmed with `film`, and recorded with `record`.
    """

    task: str | None = None
    goal: str | None = None
    call: str | None = None
    arguments: dict[str, str] = {}
    seed: Annotated[int, msgspec.Meta(ge=0, le=2**31)] = 0
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)] = 600.0
    film: bool = False
    record: bool = False


class TrialsRequest(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, forbid_unknown_fields=True):
    """A task of the cell's library with arguments, to run `number` times from the cell's scene, with seeds from `seed`.

    `disturb` is what disturbs each trial; one may take `deadline_s` s of wall time.
    """

    task: str
    arguments: dict[str, str] = {}
    number: Annotated[int, msgspec.Meta(ge=1, le=1000)] = 50
    seed: Annotated[int, msgspec.Meta(ge=0, le=2**31)] = 0
    disturb: Disturbance = "none"
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)] = 3600.0


Measure: TypeAlias = Literal["work", "proven work", "makespan"]


class WorldFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A fact, and how it is known: `evidence` is None for what the scene or a person stated, and by whom or what."""

    fact: LabelledFact
    evidence: Evidence | None = None
    origin: str = ""


class WorldText(msgspec.Struct, frozen=True):
    """A world after the write `sequence`, as text."""

    sequence: int
    text: str


class WorldFacts(msgspec.Struct, frozen=True):
    """Some of the `total` facts that were asked for, of the world after the write `sequence`."""

    sequence: int
    total: int
    facts: tuple[WorldFact, ...]


class WorldWrite(msgspec.Struct, frozen=True):
    """A write to the world: its number, when it was made, who or what made it, how that is known, and the changes.

    `written_ns` is the wall time in ns since 1970, 0 if it is not known; `evidence` is None for what a person states.
    `undo` are the changes that lead back to the world before.
    """

    sequence: int
    written_ns: int
    origin: str
    evidence: Evidence | None
    changes: tuple[LabelledChange, ...]
    undo: tuple[LabelledChange, ...] = ()


class PreviewedStep(msgspec.Struct, frozen=True):
    """A step of a plan: its skill, its arguments in short names, where the skill is defined, and when it runs, in s.

    The times are those of a schedule; without one they are None.
    """

    skill: str
    arguments: dict[str, str]
    source: str
    start_s: float | None = None
    duration_s: float | None = None


class OmittedPart(msgspec.Struct, frozen=True):
    """Things without which a plan was made, and why; `harmless` if that is proved to make no difference."""

    kind: str
    what: tuple[str, ...]
    why: str
    harmless: bool


class PlanPreview(msgspec.Struct, frozen=True, kw_only=True):
    """The answer of the planners for the world after the write `sequence`; as `skillc plan` prints it in `text`.

    `failure` and `causes` say why there is no plan. `optimal` is what is proved of a plan, `at_least_s` the lower bound
    of what was minimised. `duration_s` is the work of all steps, `makespan_s` the time until the last one ends.
    """

    status: Literal["solved", "unsolvable", "gave-up"]
    sequence: int
    text: str
    plan: tuple[PreviewedStep, ...] = ()
    plan_optimal: bool = False
    optimal: str = ""
    at_least_s: float | None = None
    quality: str = ""
    assumptions: tuple[str, ...] = ()
    left_out: tuple[OmittedPart, ...] = ()
    duration_s: float | None = None
    makespan_s: float | None = None
    planner: str = ""
    times: str | None = None
    note: str | None = None
    failure: str = ""
    causes: tuple[str, ...] = ()
    searched: bool | None = None


class QueryRows(msgspec.Struct, frozen=True):
    """The answer to a query, of the world after the write `sequence`; `truncated` if there were more rows."""

    sequence: int
    columns: tuple[str, ...]
    rows: tuple[tuple[str | bool | int | float | None, ...], ...]
    truncated: bool = False
