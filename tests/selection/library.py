"""A small library over the test world: a gripper skill for two kinds of grippers, and skills that call it."""

from __future__ import annotations

from typing import Literal as OneOf

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Anything, Assert, Condition, Expression, Holds, Not, Retract, Variable
from skillc_model.skills import (
    Compound,
    Implementation,
    ImplementationBody,
    Parameter,
    Post,
    Requirement,
    Skill,
    SkillLibrary,
)
from skillc_model.skills import Primitive as PrimitiveBody
from skillc_rdf.vocabulary.types import ClassTerm, NumberType, Vocabulary
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.world_state import WorldState
from world.lab import CLASSES, FUNCTIONS, PROPERTIES, RELATIONS, assign, fact, holds, individual, iri, parameter

MOVES = PrimitiveBody("selection.library:Moves")

VOCABULARY = Vocabulary(
    prefixes={"t": "http://example.org/test#"},
    classes={
        term.iri: term
        for term in (
            *CLASSES,
            ClassTerm(iri=iri("RobotiqGripper"), parents=(iri("Gripper"),)),
            ClassTerm(iri=iri("SuctionCup"), parents=(iri("Gripper"),)),
        )
    },
    relations={term.iri: term for term in RELATIONS},
    properties={term.iri: term for term in PROPERTIES},
    functions={term.name: term for term in FUNCTIONS},
)
FACTS: tuple[Change, ...] = (
    individual("shelf", "Location"),
    individual("table", "Location"),
    individual("arm", "CompliantArm"),
    individual("gripper", "WsgGripper"),
    individual("cup", "SuctionCup"),
    individual("eraser", "Eraser"),
    individual("box", "Product"),
    fact("arm", "hasGripper", "gripper"),
    fact("shelf", "contain", "eraser"),
    fact("table", "contain", "box"),
    assign("box", "weight", 3.0),
    assign("arm", "state", "Idle"),
)


class Moves(Primitive):
    """A primitive that takes a gripper and a force."""

    def __init__(self, cell: object, *, gripper: str, force: float | None) -> None:
        super().__init__(cell)  # type: ignore[arg-type]

    def tick(self) -> Status:
        return Status.SUCCESS


class Grips(Primitive):
    """A primitive that takes what Pick has."""

    def __init__(self, cell: object, **parameters: object) -> None:
        super().__init__(cell)  # type: ignore[arg-type]

    def tick(self) -> Status:
        return Status.SUCCESS


def scene(*changes: Change) -> WorldState:
    """Return the scene, changed."""
    return WorldState.empty(VOCABULARY).with_changes([*FACTS, *changes])


def at(line: int) -> Position:
    """Return a place."""
    return Position("work.skill", line, 1)


def force(low: float | None = None, high: float | None = None, default: Expression | None = None) -> Parameter:
    """Make the optional parameter `force`."""
    type_ = NumberType("Force")
    return Parameter(name="force", direction="opt", type=type_, low=low, high=high, default=default, source=at(2))


def requirement(label: str, condition: Condition, line: int = 3) -> Requirement:
    """Make a condition whose text is its label."""
    return Requirement(label="", condition=condition, text=label, source=at(line))


def impl(
    skill: str,
    name: str,
    *parameters: Parameter,
    body: ImplementationBody = MOVES,
    pre: tuple[Requirement, ...] = (),
    hold: tuple[Requirement, ...] = (),
    post: tuple[Post, ...] = (),
) -> Implementation:
    """Make an implementation."""
    return Implementation(
        name=name, skill=skill, parameters=parameters, pre=pre, hold=hold, post=post, body=body, source=at(5)
    )


def call(skill: str, implementation: str | None = None, line: int = 20, **arguments: Expression) -> tree.Call:
    """Make a call."""
    return tree.Call(skill=skill, implementation=implementation, arguments=arguments, out=None, source=at(line))


def gripper(cls: str, direction: OneOf["in", "infer"] = "in") -> Parameter:
    """Make the parameter `gripper` of a class."""
    return parameter("gripper", cls, direction)


MOUNTED = requirement("arm hasA gripper", holds("arm", "hasA", "gripper"), 31)
THERE = requirement("from contain object", holds("from", "contain", "object"), 32)
EMPTY = requirement("not gripper contain _", Not(Holds(Variable("gripper"), iri("contain"), Anything())), 33)
HELD = Post(
    label="held",
    condition=holds("gripper", "contain", "object"),
    effects=(
        Assert(Variable("gripper"), iri("contain"), Variable("object")),
        Retract(Variable("from"), iri("contain"), Variable("object")),
    ),
    sensed=False,
    text="gripper contain object",
    source=at(34),
)
PICK = (parameter("arm", "Arm", "in"), parameter("object", "Product", "in"), gripper("Gripper", "infer"))
PICKING = tree.Sequence(
    children=(call("Actuate", gripper=Variable("gripper")), call("Hold", gripper=Variable("gripper"), line=21)),
    reactive=False,
    source=at(19),
)


def library(*more: Implementation) -> SkillLibrary:
    """Return the library, with more implementations behind those it has."""
    implementations = (
        impl("Actuate", "wsg", gripper("WsgGripper"), force(5.0, 80.0)),
        impl("Actuate", "robotiq", gripper("RobotiqGripper"), force(15.0, 70.0)),
        impl("Hold", "tight", gripper("Gripper"), body=PrimitiveBody("selection.library:Grips")),
        impl(
            "Pick",
            "from_above",
            *PICK,
            parameter("from", "Location"),
            body=Compound(PICKING),
            pre=(MOUNTED, THERE, EMPTY),
            post=(HELD,),
        ),
        *more,
    )
    names = {
        each.skill: tuple(one.name for one in implementations if one.skill == each.skill) for each in implementations
    }
    skills = {
        name: Skill(name=name, implementations=impls, source=at(1), fallback=name.startswith("Fallback"))
        for name, impls in names.items()
    }
    return SkillLibrary(
        name="work",
        namespace="https://w3id.org/skillc/library/work#",
        hash="",
        vocabulary=VOCABULARY,
        skills=skills,
        implementations={f"{each.skill}.{each.name}": each for each in implementations},
    )
