"""A depot where robots carry crates: a library, a world, and a cell in which every step takes as long as it says."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from own_backend import OwnBackend
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_compiler.goals.parsing import parse_goal
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.control.supervision.watchdog import HeartbeatWatchdog
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.recording.events import Event
from skillc_runtime.world.state.changes import AddIndividual, AddRelation
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
SKIROS, SKILLC = "http://rvmi.aau.dk/ontologies/skiros.owl#", "https://w3id.org/skillc/core#"
AT, CONTAIN = SKIROS + "at", SKIROS + "contain"


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(Path(__file__).with_name("depot.skill")))


def iri(name: str) -> str:
    return LAB + name


def contain(holder: str, held: str) -> AddRelation:
    return AddRelation(iri(holder), CONTAIN, iri(held))


def world(robots: dict[str, str], crates: dict[str, str], places: str = "a b c d") -> WorldState:
    """Return robots and crates by the places where they are."""
    changes = [AddIndividual(iri(name), (SKIROS + "Location",)) for name in places.split()]
    changes += [AddIndividual(iri(name), (SKILLC + "MobileRobot",)) for name in robots]
    changes += [AddIndividual(iri(name), (SKIROS + "Product",)) for name in crates]
    facts = [AddRelation(iri(name), AT, iri(place)) for name, place in robots.items()]
    facts += [contain(place, name) for name, place in crates.items()]
    return WorldState.empty(library().vocabulary).with_changes([*changes, *facts])


def goal(text: str, state: WorldState) -> Condition:
    individuals = {each: sorted(state.types(each)) for each in state.individuals}
    outcome = parse_goal(text, library().vocabulary, individuals, {**state.vocabulary.prefixes, "lab": LAB})
    assert outcome.value is not None, outcome.diagnostics
    return outcome.value


@dataclass
class Depot(OwnBackend):
    """The cell; `meanwhile` happens once, when its time has come; `fails` says which start of which step fails.

    `sensed` is what the step that runs at some time senses.
    """

    world: WorldModel
    meanwhile: dict[float, Callable[[WorldModel], object]] = field(default_factory=dict)
    sensed: dict[float, Callable[[WorldModel], object]] = field(default_factory=dict)
    fails: Callable[[str, int], bool] = lambda step, number: False
    now: float = 0.0
    watchdog: HeartbeatWatchdog = field(default_factory=HeartbeatWatchdog)
    log: list[str] = field(default_factory=list)

    def camera(self) -> Depot:
        """Return what primitives look at: the depot itself, of which a run shows them only the devices."""
        return self

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Tell that nothing here moves."""
        return True

    def secure(self, devices: Collection[str] | None = None) -> tuple[str, ...]:
        """Leave nothing behind, for nothing here moves."""
        return ()

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        self.now += seconds
        self.let_happen(self.meanwhile)

    def let_happen(self, due: dict[float, Callable[[WorldModel], object]]) -> None:
        """Do once what is due."""
        for time in [time for time in due if time <= self.now]:
            due.pop(time)(self.world)


class Scripted(Primitive):
    """A step that takes its time, and fails in the end where the depot says so."""

    def __init__(self, cell: Depot, *, robot: str, **others: str) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self._depot = cell.camera()
        named = {name: value.removeprefix(LAB) for name, value in others.items()}
        words = (named[key] for key in ("crate", "from", "to") if key in named)
        self._name = " ".join((robot.removeprefix(LAB), *words))
        self._lasts = 2.0 if "crate" in named else 5.0

    def start(self) -> None:
        self._depot.log.append(self._name)
        self._fails = self._depot.fails(self._name, self._depot.log.count(self._name))
        self._ends = self._depot.now + self._lasts

    def tick(self) -> Status:
        self._depot.let_happen(self._depot.sensed)
        if self._depot.now < self._ends:
            return Status.RUNNING
        if self._fails:
            raise SkillFailure(f"{self._name} failed")
        return Status.SUCCESS


def carried_out(text: str, state: WorldState, depot: Depot, events: list[Event] | None = None) -> Execution:
    """Plan for a goal and carry it out."""
    prepared = prepare_task(Assignment("carry", state, AchieveGoal(goal(text, state))), library())
    assert isinstance(prepared, PreparedTask), prepared
    listeners = [] if events is None else [events.append]
    return execute_task(prepared, library(), depot, listeners)  # type: ignore[arg-type]
