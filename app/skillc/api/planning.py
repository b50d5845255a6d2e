"""Plans for goals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

from skillc.api.boundary import NoticeList, api_call
from skillc.api.picture import Picture
from skillc.errors import ServiceError
from skillc.services.planning.plan_text import describe_answer, format_plan
from skillc.services.planning.planning import keep_within, plan_goal, prepare_planners
from skillc.services.space.claims import plan_goal_in_space
from skillc.services.tasks.loading import LoadedTask, check_request, fill_in, load_task, with_always, with_measure
from skillc.services.views.schedule_picture import draw_schedule
from skillc.values.arguments import (
    AnyPath,
    optional_seconds,
    require_choice,
    require_flag,
)
from skillc.values.frames import make_frame, make_table
from skillc.values.keywords import read_keywords, read_texts
from skillc.values.run_keywords import RunKeywords
from skillc_model.skills import PlanMeasure
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.plan import GaveUp, Solved, Unsolvable, describe_quality
from skillc_runtime.planning.schedule import DEADLINE_S, PlanAnswer, Scheduled
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.space_claim import SpaceClaim

if TYPE_CHECKING:
    import pandas as pd

PLAN_COLUMNS = ("step", "skill", "arguments", "start_s", "duration_s")


class PlanKeywords(TypedDict, total=False):
    """How is planned, as `plan` says."""

    always: Sequence[str]
    minimise: PlanMeasure | None
    prove: bool
    deadline_s: float
    geometry: bool


class PlanningError(ServiceError):
    """There is no plan. `proved` says whether that is certain, `causes` what the cell lacks or cannot do."""

    def __init__(self, answer: Unsolvable | GaveUp) -> None:
        super().__init__(answer.message)
        self.proved = isinstance(answer, Unsolvable)
        self.causes = answer.causes
        self.explanation = answer.why


@dataclass(frozen=True, slots=True)
class PlannedStep:
    """A step of a plan: its skill, its arguments by parameter in short names, and when it is expected to run, in s."""

    skill: str
    arguments: dict[str, str]
    start_s: float
    duration_s: float

    def __str__(self) -> str:
        return f"{self.skill}({', '.join(f'{name}: {value}' for name, value in self.arguments.items())})"


@dataclass(frozen=True, slots=True)
class Plan:
    """A plan, with its steps in the order in which they start; notebooks show it as a schedule.

    `duration_s` is the expected work of all steps, `makespan_s` the time from start to end, in s, when steps that do
    not wait for each other run in parallel. `optimal` is what is proved of it, `quality` the same as text, `space` what
    is known of it in space, None if nobody has looked.
    """

    task: str
    steps: tuple[PlannedStep, ...]
    duration_s: float
    makespan_s: float
    optimal: str
    quality: str
    planner: str
    space: SpaceClaim | None
    _loaded: LoadedTask = field(repr=False, compare=False)
    _answer: PlanAnswer = field(repr=False, compare=False)

    def __str__(self) -> str:
        """Return the steps and how good the plan is, as `skillc plan` prints them."""
        return format_plan(self._answer, self._loaded, self.space)

    def __len__(self) -> int:
        return len(self.steps)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain data, as `skillc plan --json` prints it."""
        return describe_answer(self._answer, self._loaded, self.space)

    def to_frame(self) -> pd.DataFrame:
        """Return a pandas frame with a row for each step. SkillcError if pandas is not installed."""
        return make_frame([dict(zip(PLAN_COLUMNS, row, strict=True)) for row in self._rows()], PLAN_COLUMNS)

    def draw(self) -> Picture:
        """Return its picture: a bar for each step over time."""
        bars = [(str(each), each.start_s, each.duration_s) for each in self.steps]
        return Picture(self.task, draw_schedule(bars, f"{self.task}: {self.quality}"))

    def _rows(self) -> list[tuple[int, str, str, float, float]]:
        return [
            (number, each.skill, str(each).removeprefix(each.skill)[1:-1], each.start_s, each.duration_s)
            for number, each in enumerate(self.steps, 1)
        ]

    def _repr_svg_(self) -> str:
        return self.draw().svg

    def _repr_html_(self) -> str:
        return f"{self._repr_svg_()}{make_table(PLAN_COLUMNS, self._rows())}<p>{escape(self.quality)}</p>"


def plan(
    task: str | None = None,
    *,
    arguments: Mapping[str, Any] | None = None,
    goal: str | None = None,
    scene: AnyPath | None = None,
    library: AnyPath | None = None,
    **settings: Unpack[PlanKeywords],
) -> Plan:
    """Plan for a task, or for a goal in a scene, without running it.

    `task` is `LIBRARY:NAME`, or the name of a task of the project here or of a shipped one; without it and without a
    goal, it is the default task of the project. `arguments` are the values of its parameters by name, such as
    `{"surface": "lab:Table-1"}`. `goal` is a condition or PDDL, `scene` a file or the name of a shipped scene,
    `library` the folder, file or name of the skills. `always` are conditions that no state of the plan breaks, besides
    those of the task. `minimise` is `work`, `makespan` or `cost`, by default as its task
    says, or work; `prove` plans with more of a large scene until the least work is proved. The search ends after
    `deadline_s` s, by default 30. The arms can carry out the plan, as far as is known, beginning at home; without
    `geometry` nobody looks.

    PlanningError if there is no plan or none was found in time, DiagnosticsError if the library, the scene or the goal
    has errors, RequestError if what is named does not exist or cannot be planned for.
    """
    with api_call():
        given = {"arguments": arguments, "goal": goal, "scene": scene, "library": library}
        spec = fill_in(read_keywords(RunSpec, given, RunKeywords, task))
        check_request(spec, calls=False)
        with load_task(spec, NoticeList()) as loaded:
            return make_plan(loaded, **settings)


def make_plan(
    loaded: LoadedTask,
    always: Sequence[str] = (),
    minimise: PlanMeasure | None = None,
    prove: bool = False,
    deadline_s: float = DEADLINE_S,
    geometry: bool = True,
) -> Plan:
    """Plan for a loaded task; errors as of `plan`."""
    chosen = None if minimise is None else require_choice(minimise, PlanMeasure, "`minimise`")
    loaded = with_measure(with_always(loaded, read_texts(always, "`always`")), chosen)
    limit_s = optional_seconds(deadline_s, "`deadline_s`")
    planners, cancel = prepare_planners(True), CancelToken(limit_s or DEADLINE_S)
    if require_flag(geometry, "`geometry`"):
        answer, space = plan_goal_in_space(loaded, planners, cancel, prove=prove)
    else:
        answer, space = plan_goal(loaded, planners, cancel, prove=prove), None
    answer, space = keep_within(answer, space, loaded)
    if isinstance(answer, Unsolvable | GaveUp):
        raise PlanningError(answer)
    return _as_plan(answer, loaded, space)


def _as_plan(answer: Solved | Scheduled, loaded: LoadedTask, space: SpaceClaim | None) -> Plan:
    state = loaded.assignment.state
    known, costs = (
        loaded.assignment.plan_library(loaded.library),
        isinstance(answer, Solved) and answer.cost is not None,
    )
    schedule = answer.schedule if isinstance(answer, Scheduled) else schedule_plan(answer.plan, known, state)
    steps = tuple(
        PlannedStep(each.step.skill, _shorten(each.step.arguments, loaded), each.start_s, each.duration_s)
        for each in schedule.steps
    )
    return Plan(
        task=loaded.assignment.name,
        steps=steps,
        duration_s=answer.plan.duration_s,
        makespan_s=schedule.makespan_s,
        optimal=answer.optimal,
        quality=describe_quality(answer.optimal, answer.left_out, answer.at_least_s, costs),
        planner=answer.planner,
        space=space,
        _loaded=loaded,
        _answer=answer,
    )


def _shorten(arguments: dict[str, str], loaded: LoadedTask) -> dict[str, str]:
    short = loaded.assignment.state.vocabulary.short
    return {name: short(iri) for name, iri in arguments.items()}
