"""A cell with one arm on the test bench, whose skills are ticked as the tree does it."""

from functools import cache

from rig import HOMES, Bench

from simulation.cells import begin
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    HAS_POSTURE,
    HAS_SHEET,
    JOINT_VALUES,
    POSTURE_NAME,
    SKILLC,
    SURFACE,
)
from skillc_runtime.world.state.world_state import WorldState

ARM, BOARD, SHEET, HOME = (f"http://example.org/lab#{name}" for name in ("Arm", "Board", "Sheet", "Home"))
DATA_SHEET, POSTURE = SKILLC + "ArmSheet", SKILLC + "Posture"


@cache
def vocabulary():
    return load([Source(path, text) for path, text in vocabulary_files()]).value


def world(robot):
    """The world of an arm whose sheet knows one posture, and of a board that is somewhere."""
    individuals = {ARM: ARM_DEVICE, BOARD: SURFACE, SHEET: DATA_SHEET, HOME: POSTURE}
    facts = [
        *(AddIndividual(individual, (cls,)) for individual, cls in individuals.items()),
        AddRelation(ARM, HAS_SHEET, SHEET),
        AddRelation(SHEET, HAS_POSTURE, HOME),
        SetProperty(HOME, POSTURE_NAME, "home"),
        SetProperty(HOME, JOINT_VALUES, " ".join(map(str, HOMES[robot]))),
    ]
    return WorldModel(WorldState.empty(vocabulary()).with_changes(facts))


class OneArm:
    """A cell with one arm, and what a tree does with a primitive."""

    def __init__(self, robot: str, **options) -> None:
        self.bench, self.world = Bench(robot, **options), world(robot)
        self.bench.run(0.02)

    @property
    def now(self):
        return self.bench.data.time

    def arm(self, individual):
        assert individual == ARM
        return self.bench.driver

    def preferred_postures(self, individual):
        return ()

    def run(self, primitive, limit=20.0, beside=()):
        """Start and tick every 10 ms until it succeeds; SkillFailure comes out, from a tick after the halt."""
        end = self.now + limit
        begin(primitive)
        try:
            while primitive.tick() is Status.RUNNING:
                assert self.now < end, "it does not end"
                assert all(other.tick() is Status.RUNNING for other in beside)
                self.bench.run(0.01)
        except SkillFailure as failure:
            primitive.halt(str(failure))
            raise
        return primitive
