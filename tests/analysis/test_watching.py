"""What `verify never` forbids ends a skill while it runs, and `try` does not hide it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from skillc_model import tree
from skillc_model.conditions import Compare, Literal, Variable
from skillc_model.properties import ConditionEvent, Measures, Property, VerifyEvent
from skillc_model.skills import Compound, Parameter, Skill, SkillLibrary
from skillc_rdf.vocabulary.types import ClassTerm, ClassType, Vocabulary
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import ARM_DEVICE
from tree.library import DEVICE, DEVICES, FLAGS, ON, THE_FLAG, Library, act, call, here, is_on, world
from tree.stage import Script, Stage

THE_ARM = Parameter(name="arm", direction="in", type=ClassType(DEVICE), source=here())
TOO_MUCH = Measures("force", ">", Literal(25.0))


@dataclass
class Measured:
    """What an arm measures; None if it feels no force."""

    felt: np.ndarray | None


@dataclass
class Arm:
    """An arm that feels a force."""

    measured: Measured


@dataclass
class Cell(Stage):
    """A stage with one arm."""

    force_n: float | None = 0.0

    def arm(self, individual: str) -> Arm:
        """Return the arm."""
        force_n = self.force_n
        return Arm(Measured(None if force_n is None else np.array([0.0, 0.0, -force_n, 99.0, 0.0, 0.0])))


def library(event: VerifyEvent) -> SkillLibrary:
    """Return a library with a skill that acts while something must never be."""
    built = Library()
    built.add(Skill(name="Careful", parameters=(THE_FLAG, THE_ARM), source=here()), Compound(act("a")))
    made = built.build()
    line = Property(pattern="never", first=event, text="verify never that", source=here())
    careful = made.implementations["Careful.way0"]
    changed = type(careful)(**{f: getattr(careful, f) for f in careful.__struct_fields__} | {"verify": (line,)})
    known = made.vocabulary
    classes = {
        **known.classes,
        ARM_DEVICE: ClassTerm(iri=ARM_DEVICE),
        DEVICE: ClassTerm(iri=DEVICE, parents=(ARM_DEVICE,)),
    }
    values = {field: getattr(made, field) for field in made.__struct_fields__}
    vocabulary = Vocabulary(**{f: getattr(known, f) for f in known.__struct_fields__} | {"classes": classes})
    implementations = {**made.implementations, "Careful.way0": changed}
    return SkillLibrary(**values | {"implementations": implementations, "vocabulary": vocabulary})


def started(event: VerifyEvent, force_n: float = 0.0) -> tuple[Cell, TreeRun]:
    """Start the skill, in a `try`."""
    cell = Cell(world(), {"a": [Script("success", 3)]}, force_n=force_n)
    body = tree.Try(child=call("Careful", flag=FLAGS[0], arm=DEVICES[0]), source=here())
    run = TreeRun(body, library(event), cell)  # type: ignore[arg-type]
    assert run.tick() is Status.RUNNING
    return cell, run


def test_a_forbidden_condition_ends_the_skill() -> None:
    off = ConditionEvent(Compare(is_on(Variable("flag")).left, "==", Literal(False)))  # type: ignore[union-attr]
    cell, run = started(off)
    assert run.tick() is Status.RUNNING
    cell.world.commit([SetProperty(FLAGS[0], ON, False)])
    assert run.tick() is Status.FAILURE
    assert run.failure is not None and (run.failure.kind, run.failure.skill) == ("verify", "Careful")
    assert cell.said("halt") == ["halt a"]


@pytest.mark.parametrize(("force_n", "status"), [(24.0, Status.SUCCESS), (26.0, Status.FAILURE)])
def test_the_force_is_measured_in_every_tick(force_n: float, status: Status) -> None:
    cell, run = started(TOO_MUCH)
    cell.force_n = force_n
    run.tick()
    assert run.tick() is status
    if run.failure is not None:
        assert run.failure.message == "`verify never that` is violated: stage:device0 measures 26.0 N"


def test_an_arm_that_feels_nothing_cannot_keep_below_a_force() -> None:
    cell, run = started(TOO_MUCH)
    cell.force_n = None
    run.tick()
    assert run.tick() is Status.FAILURE and run.failure is not None
    assert run.failure.message == "`verify never that` is violated: stage:device0 has nothing that measures its force"
