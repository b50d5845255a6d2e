"""A cell without physics: parts lie where `truth` says, devices tell it, and skills look or do not."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from msgspec import structs

from own_backend import OwnBackend
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_compiler.goals.parsing import parse_call, parse_goal
from skillc_model.skills import SkillLibrary
from skillc_runtime.control.supervision.watchdog import HeartbeatWatchdog
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.recording.events import Event
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    ARRIVAL_TOLERANCE,
    AT,
    BASE_FRAME_ID,
    BASE_SHEET,
    CONTAIN,
    FRAME_ID,
    HAS_SHEET,
    IS_CLEAN,
    LOCATED,
    ORIENTATION,
    POSITION,
    SKILLC,
    SKIROS,
    WIPING,
)
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
RPARTS = "http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#"


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(Path(__file__).with_name("bench.skill")))


def iri(name: str) -> str:
    return LAB + name


def world(clean: bool = False) -> WorldState:
    """Return a part in a tray, a box, a gripper, a table, and a robot at the dock, from which a shelf is 2 m away."""
    kinds = {
        "tray": SKIROS + "Location",
        "box": SKIROS + "Location",
        "dock": SKILLC + "Workstation",
        "shelf": SKILLC + "Workstation",
        "part": SKIROS + "Product",
        "gripper": RPARTS + "GripperEffector",
        "table": WIPING + "TableTop",
        "robot": SKILLC + "MobileRobot",
        "sheet": BASE_SHEET,
    }
    changes = [AddIndividual(iri(name), (kind,)) for name, kind in kinds.items()]
    changes += [AddRelation(iri("tray"), CONTAIN, iri("part")), AddRelation(iri("robot"), AT, iri("dock"))]
    changes += [AddRelation(iri("robot"), HAS_SHEET, iri("sheet")), SetProperty(iri("table"), IS_CLEAN, clean)]
    changes += [SetProperty(iri("sheet"), ARRIVAL_TOLERANCE, 0.1)]
    for name, x in (("dock", 0.0), ("shelf", 2.0)):
        places = dict(zip((*POSITION, *ORIENTATION), (x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0), strict=True))
        frame = {FRAME_ID: name, BASE_FRAME_ID: "map", **places}
        changes += [SetProperty(iri(name), property_, value) for property_, value in frame.items()]
    known = library().vocabulary
    return WorldState.empty(structs.replace(known, prefixes={**known.prefixes, "lab": LAB})).with_changes(changes)


@dataclass
class Hand:
    """A gripper that reports what it holds."""

    holding: str | None = None


@dataclass
class Base:
    """A base that reports where it stands."""

    pose: Pose = field(default_factory=lambda: Pose.of((0.0, 0.0, 0.0)))
    at_rest: bool = True


@dataclass
class Bench(OwnBackend):
    """The cell; `meanwhile` happens once, when its time has come."""

    world: WorldModel
    meanwhile: dict[float, Callable[[Bench], object]] = field(default_factory=dict)
    now: float = 0.0
    watchdog: HeartbeatWatchdog = field(default_factory=HeartbeatWatchdog)
    hand: Hand = field(default_factory=Hand)
    wheels: Base = field(default_factory=Base)

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether nothing more is to happen."""
        return not self.meanwhile

    def gripper(self, individual: str) -> Hand:
        """Return the one gripper."""
        return {iri("gripper"): self.hand}[individual]

    def base(self, individual: str) -> Base:
        """Return the one base."""
        return {iri("robot"): self.wheels}[individual]

    def secure(self, devices: Collection[str] | None = None) -> tuple[str, ...]:
        """Leave nothing behind, for nothing here moves."""
        return ()

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        self.now += seconds
        for time in [time for time in self.meanwhile if time <= self.now]:
            self.meanwhile.pop(time)(self)


class Does(Primitive):
    """Takes half a second and looks at nothing."""

    def __init__(self, cell: Bench, **parameters: str) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self._parameters, self._ends = parameters, cell.now + 0.5

    def tick(self) -> Status:
        if self.cell.now < self._ends:
            return Status.RUNNING
        self.done(self.cell.world, **self._parameters)
        return Status.SUCCESS

    def done(self, world: WorldModel, **parameters: str) -> None:
        """Nothing more."""


class Writes(Does):
    """Writes what it never looked at."""

    def done(self, world: WorldModel, *, surface: str) -> None:
        world.commit([SetProperty(surface, IS_CLEAN, True)], "Pretend")


class Measures(Does):
    """Reads a device."""

    def done(self, world: WorldModel, *, surface: str) -> None:
        world.commit([SetProperty(surface, IS_CLEAN, True)], "Measure", "sensed")


class Finds(Does):
    """Reads a device."""

    def done(self, world: WorldModel, *, surface: str) -> None:
        world.commit([SetProperty(surface, LOCATED, True)], "Find", "sensed")


class Tells(Does):
    """Says what came of it, by the name of the outcome."""

    def done(self, world: WorldModel, *, surface: str) -> None:
        self.outcome = "gone" if "gone" in self.outcomes else "lost"


class Guesses(Does):
    """Writes what it never looked at."""

    def done(self, world: WorldModel, *, surface: str) -> None:
        world.commit([SetProperty(surface, LOCATED, True)], "Find")


class Looks(Does):
    """Reads a device."""

    def done(self, world: WorldModel, *, part: str, at: str) -> None:
        world.commit([AddRelation(at, CONTAIN, part)], "Look", "sensed")


class Grips(Does):
    """Closes the hand, which feels the part."""

    def done(self, world: WorldModel, *, gripper: str, part: str, **_: str) -> None:
        self.cell.gripper(gripper).holding = part  # type: ignore[misc]
        world.commit([AddRelation(gripper, CONTAIN, part)], "Take", "sensed")


def run(aim: str, bench: Bench, events: list[Event] | None = None) -> Execution:
    """Run `goal ..` or a call to its end."""
    state, lib = bench.world.snapshot(), library()
    individuals = {each: sorted(state.types(each)) for each in state.individuals}
    prefixes = {**state.vocabulary.prefixes, "lab": LAB}
    if aim.startswith("goal "):
        asked = parse_goal(aim.removeprefix("goal "), lib.vocabulary, individuals, prefixes)
        assert asked.value is not None, asked.diagnostics
        prepared = prepare_task(Assignment("task", state, AchieveGoal(asked.value)), lib)
    else:
        called = parse_call(aim, lib, individuals, prefixes)
        assert called.value is not None, called.diagnostics
        prepared = prepare_task(Assignment("task", state, ExecuteBody(called.value)), lib)
    assert isinstance(prepared, PreparedTask), prepared
    return execute_task(prepared, lib, bench, [] if events is None else [events.append])  # type: ignore[arg-type]
