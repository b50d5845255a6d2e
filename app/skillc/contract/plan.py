"""Plans for a cell: what would be done, or why nothing can be."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from skillc.contract.values import CheckedBody
from skillc_model.skills import PlanMeasure as PlanMeasure
from skillc_runtime.recording.space_claim import SpaceClaim

MAX_PLANNING_S = 60.0


class PlanRequest(CheckedBody, frozen=True, kw_only=True, tag_field="kind", tag="plan", forbid_unknown_fields=True):
    """A task of a cell's library with arguments, or a goal as a condition or as PDDL, to plan for.

    `cell` may be left out if there is only one, and `minimise` for what the task says, or else work. `prove` searches
    until the least work is proved; the search ends after `deadline_s` s. With `geometry` plans are looked at in space,
    from where the arms are.
    """

    cell: str | None = None
    task: str | None = None
    goal: str | None = None
    arguments: dict[str, str] = msgspec.field(default_factory=dict)
    minimise: PlanMeasure | None = None
    prove: bool = False
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_PLANNING_S)] = 30.0
    geometry: bool = True

    def check(self) -> None:
        """Raise ValueError if it is to be proved that a plan has the least makespan."""
        if self.prove and self.minimise == "makespan":
            raise ValueError("`prove` is for the work; a makespan has a lower bound")


class PreviewedStep(msgspec.Struct, frozen=True):
    """A step of a plan: its skill, its arguments in short names, where the skill is defined, and when it runs, in s.

    The times are those of a schedule; without one they are None.
    """

    skill: str
    arguments: dict[str, str]
    source: str
    start_s: float | None = None
    duration_s: float | None = None


class PreviewedBranch(msgspec.Struct, frozen=True, kw_only=True):
    """How a policy goes on after an outcome of its last step, and how likely that is, from 0 to 1.

    `plan` is None if it is planned when the outcome comes. `duration_s` is the expected duration of the branch, in s.
    """

    outcome: str
    likely: float
    plan: tuple[PreviewedStep, ...] | None = None
    duration_s: float | None = None
    branches: tuple[PreviewedBranch, ...] = ()


class OmittedPart(msgspec.Struct, frozen=True):
    """Things without which a plan was made, and why; `harmless` if that is proved to make no difference."""

    kind: str
    what: tuple[str, ...]
    why: str
    harmless: bool


class PlanPreview(msgspec.Struct, frozen=True, kw_only=True):
    """The answer of the planners for the world after the write `sequence`; as `skillc plan` prints it in `text`.

    `failure` and `causes` say why there is no plan. `minimise` is what a plan has little of, `optimal` what is proved
    of that, `at_least_s` its lower bound. `duration_s` is the work, `makespan_s` the time until the last step ends.
    `space` is what is known of the plan in space, None if nobody has looked. A policy goes on with one of its
    `branches`, and takes `worst_s` if always the longest comes.
    """

    status: Literal["solved", "unsolvable", "gave-up"]
    sequence: int
    text: str
    minimise: PlanMeasure = "work"
    plan: tuple[PreviewedStep, ...] = ()
    plan_optimal: bool = False
    optimal: str = ""
    at_least_s: float | None = None
    quality: str = ""
    assumptions: tuple[str, ...] = ()
    left_out: tuple[OmittedPart, ...] = ()
    duration_s: float | None = None
    cost: float | None = None
    makespan_s: float | None = None
    planner: str = ""
    times: str | None = None
    note: str | None = None
    failure: str = ""
    causes: tuple[str, ...] = ()
    searched: bool | None = None
    space: SpaceClaim | None = None
    branches: tuple[PreviewedBranch, ...] = ()
    worst_s: float | None = None
