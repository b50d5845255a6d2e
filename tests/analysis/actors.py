"""A cell and primitives whose outcomes chance decides, for running what was proved."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.control.supervision.watchdog import HeartbeatWatchdog
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

NS = "https://w3id.org/skillc/library/play#"
ITEMS, SPOTS = tuple(f"{NS}item{n}" for n in range(3)), tuple(f"{NS}spot{n}" for n in range(2))


@dataclass
class Chance:
    """A cell whose clock the test moves and whose primitives end as `random` says."""

    world: WorldModel
    random: Random
    now: float = 0.0
    notes: list[str] = field(default_factory=list)
    watchdog: HeartbeatWatchdog = field(default_factory=HeartbeatWatchdog)

    def camera(self) -> Chance:
        """Return what primitives look at: the cell itself, of which a run shows them only the devices."""
        return self


class Actor(Primitive):
    """Runs some ticks, then succeeds or fails; its effects are written by the engine."""

    def __init__(self, cell: Chance, **parameters: object) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self.chance, self.parameters = cell.camera(), parameters
        self.left = self.chance.random.randint(1, 3)

    def start(self) -> None:
        if self.chance.random.random() < 0.1:
            raise SkillFailure("refuses")

    def tick(self) -> Status:
        self.left -= 1
        if self.left > 0:
            return Status.RUNNING
        self.finish()
        if self.chance.random.random() < 0.3:
            raise SkillFailure("fails")
        return Status.SUCCESS

    def finish(self) -> None:
        """Do what is to be done at the end."""


class Sensor(Actor):
    """Writes what it measured, whatever that is, also when it fails."""

    def finish(self) -> None:
        change = SetProperty(str(self.parameters["a"]), NS + "on", self.chance.random.random() < 0.6)
        self.chance.world.commit([change], "measured", "sensed")


class Judge(Actor):
    """Finds one of the outcomes that may come."""

    def finish(self) -> None:
        self.outcome = self.chance.random.choice(sorted(self.outcomes))


def items(state: WorldState) -> list[str]:
    """A vocabulary function: some items."""
    return sorted(state.instances(NS + "Item"))[:2]


def world(vocabulary: Vocabulary, random: Random) -> WorldModel:
    """Return a world of items and spots with some facts about them."""
    changes: list[Change] = [AddIndividual(item, (NS + random.choice(("Item", "Heavy")),)) for item in ITEMS]
    changes += [AddIndividual(spot, (NS + "Spot",)) for spot in SPOTS]
    changes += [AddIndividual(value, (cls,)) for value, cls in vocabulary.enumerated.items()]
    for item in ITEMS:
        pairs = [("at", random.choice(SPOTS)), ("near", random.choice(ITEMS)), ("follows", random.choice(ITEMS))]
        changes += [AddRelation(item, NS + name, other) for name, other in pairs if random.random() < 0.6]
        if random.random() < 0.7:
            changes.append(SetProperty(item, NS + "on", random.random() < 0.5))
        if random.random() < 0.7:
            changes.append(SetProperty(item, NS + "level", float(random.randint(1, 4))))
        if random.random() < 0.6:
            changes.append(AddRelation(item, NS + "grade", random.choice(sorted(vocabulary.enumerated))))
    return WorldModel(WorldState.empty(vocabulary).with_changes(changes))
