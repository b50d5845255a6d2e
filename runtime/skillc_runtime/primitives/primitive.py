"""The life cycle of a primitive skill."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.labels.labelled import LabelledValue
from skillc_runtime.world.state.labels.labelling import make_recordable

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.devices.prompts import Prompt
    from skillc_runtime.primitives.computation import Computing
    from skillc_runtime.primitives.planned_postures import PlannedPostures
    from skillc_runtime.primitives.space_needs import SpaceNeed
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState

NOTHING: Mapping[str, str | None] = MappingProxyType({})
"""What a primitive `moves` that only moves arms, fingers and what they hold."""


class Status(Enum):
    """The state of a node or a primitive."""

    IDLE = "idle"
    RUNNING = "running"
    SUCCESS = "success"
    FAILURE = "failure"
    HALTED = "halted"


Activity: TypeAlias = Literal["", "press", "follow-path", "search"]
"""`press`: a tool is pressed on something, with `force` N; `follow-path`: it is led along a path; `search`: it is moved
about until something gives way. Empty for anything else."""

Phase: TypeAlias = Literal["begins", "ends"]
"""When a primitive begins, or when it ends well."""


class SkillFailure(Exception):
    """A primitive cannot do what it was called for; the message says why, with numbers.

    The values that are named in it, as in `SkillFailure("it sank {depth:.1f mm}", depth=Quantity(0.02, "m"))`, are put
    into the message and recorded beside it.

    `withdrawn` is None unless what was measured contradicts the world model; then it has the facts that were believed
    until `contradict` has withdrawn them, as text.
    """

    withdrawn: tuple[str, ...] | None = None

    def __init__(self, message: str, **values: LabelledValue) -> None:
        super().__init__(message.format(**values) if values else message)
        self.values = {name: make_recordable(value) for name, value in values.items()}


class SpaceLacking(SkillFailure):
    """An arm does not get where it should: its reach, a range of a joint, a way or room for it is missing.

    The same call fails again until something stands elsewhere, or something else is held.
    """


class Primitive:
    """One run of a primitive skill: created with its arguments when it starts, used once.

    A subclass takes the cell and its parameters by name: `__init__(self, cell, *, arm: str, speed: float)`.
    Individuals are passed as IRIs, quantities in SI units, unset optional parameters as None. Any method may raise
    SkillFailure; raised by `start` it means that another implementation may be tried.

    The time of the cell, `cell.now`, stands still while the run is paused. A pause concerns primitives that run, and
    scoped ones until they are released. It begins with `pause`; if it lasts longer than a force may be kept, `withdraw`
    follows and, at the end, `approach`; it ends with `resume` or `halt`.

    `activity` says what it does, for measures and disturbances. `highlights` are the moments worth a picture: of
    which parameter, and the word for what is seen then.

    `text_names` declares texts that name something, so that a misspelt one is reported before anything runs: for a
    parameter, the parameter to start from, the relations to follow and the property with the names, as IRIs.

    `moves` declares which things are elsewhere after a run, so that motions can be checked before anything moves: for a
    parameter, the parameter of the place where its individual is then, or None where that is not known. A primitive
    that does not declare it may move anything.

    `stays_put` is True where a run moves neither an arm, but for what it yields, nor what it holds: it needs no space.

    `uses_devices` is False where a run needs nothing of the cell but its clock: it goes on beside others that use all.

    The text of `note` is shown once and recorded when the start or the tick has succeeded.

    While `prompt` is not None, it is put to an operator; `answer` is called once with one of its choices.

    While `computing` is not None, it computes beside the ticks, and `tick` is not called. It is a generator that yields
    what is to be computed, and is sent the results; it is ended by `halt`. If `start` has set it, the start lasts until
    it ends: nothing may have moved if it raises SkillFailure.

    `outcomes` are the labels of what may come of its skill. If it sets `outcome` to one of them before it succeeds,
    what that outcome says is written to the world model with its `outcome_evidence`; or it writes that itself.
    `true_outcome` is the one that comes by what a scene says to be true in simulation, but not known; else empty.

    `planned_postures` are those of the plan that it is part of, None where nothing was planned.
    """

    activity: ClassVar[Activity] = ""
    highlights: ClassVar[tuple[tuple[Phase, str, str], ...]] = ()
    text_names: ClassVar[Mapping[str, tuple[str, ...]]] = MappingProxyType({})
    moves: ClassVar[Mapping[str, str | None] | None] = None
    uses_devices: ClassVar[bool] = True
    stays_put: ClassVar[bool] = False
    outcome_evidence: ClassVar[Evidence] = "sensed"
    planned_postures: PlannedPostures | None = None
    outcomes: tuple[str, ...] = ()
    outcome: str = ""
    true_outcome: str = ""

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        """Return why no run with these arguments can succeed; None if one may.

        Called before anything moves. `arguments` are those that are known, `state` is the world model as it is believed
        to be then; a pose in it may be corrected when it is sensed. FrameError and SheetError count as not known.
        """
        return None

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return what a run with these arguments needs of space, in order; None if that is not known.

        So it is known before anything moves whether the arm gets there. `arguments` and `state` are those with which a
        run would start. FrameError and SheetError count as not known.
        """
        return () if cls.stays_put else None

    def __init__(self, cell: Cell) -> None:
        self.cell = cell
        self.outputs: dict[str, object] = {}
        self.note = ""
        self.prompt: Prompt | None = None
        self.computing: Computing | None = None

    def start(self) -> None:
        """Start; nothing may have moved if this raises."""

    def tick(self) -> Status:
        """Do the work of one tick and return RUNNING or SUCCESS."""
        raise NotImplementedError

    @property
    def is_pressing(self) -> bool:
        """Whether it presses a tool on something now; one whose `activity` is to press does as long as it is active."""
        return self.activity == "press"

    def answer(self, choice: str) -> None:
        """Take what an operator has chosen; called before a tick, and only while there is a `prompt`."""

    def halt(self, reason: str) -> None:
        """Stop safely at once; called once after `start`, unless it raised SkillFailure or `tick` returned SUCCESS."""

    def pause(self) -> None:
        """Stop moving until `resume`, but go on pressing."""

    def withdraw(self) -> None:
        """Let go of what is touched; called while paused, perhaps more than once."""

    def approach(self) -> bool:
        """Touch again what was touched before `withdraw`; called in each tick until it returns true."""
        return True

    def resume(self) -> None:
        """Continue after `pause`."""

    def release(self) -> None:
        """Undo what a scoped skill set up; called exactly once when its scope ends."""
