"""Plans in events: their steps, how these are arranged, and how a policy goes on."""

from __future__ import annotations

from typing import Literal

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.labels.labelled import LabelledValue


class PlanStep(msgspec.Struct, frozen=True, kw_only=True):
    """A step of a plan: the skill, its arguments by parameter name, and what comes of it if the plan expects that."""

    skill: str
    arguments: dict[str, LabelledValue]
    source: Position | None = None
    outcome: str = ""


class PartLeftOut(msgspec.Struct, frozen=True):
    """A part of a planning problem that was left out; see `LeftOut` in `planning.plan`."""

    kind: Literal["individuals", "skills", "steps", "chains", "numbers"]
    why: str
    harmless: bool


class StepGroup(msgspec.Struct, frozen=True, omit_defaults=True):
    """Parts of a plan that run in series, or in `parallel`: indices of steps, and other groups.

    In parallel, a part may have to wait for others: `after` has their indices, for each part.
    """

    parts: tuple[int | StepGroup, ...]
    parallel: bool = False
    after: tuple[tuple[int, ...], ...] = ()


class PlanBranch(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """How a policy goes on after an outcome of its last step, and how likely that is; see `Branch` in `planning.plan`.

    `steps` is None if it is planned when the outcome comes. `duration_s` is the expected duration of the branch, in s.
    """

    outcome: str
    likely: float
    steps: tuple[PlanStep, ...] | None = None
    duration_s: float = 0.0
    branches: tuple[PlanBranch, ...] = ()


class ArrivedPlan(msgspec.Struct, frozen=True, kw_only=True):
    """A plan as the planner found it, with its steps in order.

    `arrangement` has each step, by its index in `steps`, where it runs in the body; `space` is what is known of it in
    space, None if nobody has looked. A policy goes on with one of its `branches`. The other fields are those
    of `Solved` in `planning.plan`.
    """

    planner: str
    optimal: str
    duration_s: float
    steps: tuple[PlanStep, ...]
    left_out: tuple[PartLeftOut, ...] = ()
    at_least_s: float | None = None
    assumptions: tuple[str, ...] = ()
    arrangement: StepGroup = StepGroup(())
    space: SpaceClaim | None = None
    branches: tuple[PlanBranch, ...] = ()
