"""A small library on the test vocabulary: a robot drives, picks and cleans."""

from __future__ import annotations

import msgspec

from skillc_model.conditions import (
    Anything,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Holds,
    Individual,
    Literal,
    Not,
    PropertyOf,
    Retract,
    Variable,
)
from skillc_model.pddl.names import assign_names
from skillc_model.skills import Implementation, Parameter, Post, Primitive, Requirement, Skill, SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.world_state import WorldState
from world.lab import HERE, VOCABULARY, holds, individual, iri, parameter, requirement
from world.lab import fact as fact_of


def post(condition: Condition, *, sensed: bool = False) -> Post:
    """Make the post for a literal."""
    return Post(label="", condition=condition, effects=(effect(condition),), sensed=sensed, text="", source=HERE)


def effect(condition: Condition) -> Effect:
    """Return the effect that makes a literal true."""
    match condition:
        case Holds(subject, relation, object_):
            return Assert(subject, relation, object_)  # type: ignore[arg-type]
        case Not(Holds(subject, relation, object_)):
            return Retract(subject, relation, object_)
        case Compare(PropertyOf(of, property_), "==", value):
            return Assign(of, property_, value)  # type: ignore[arg-type]
    raise AssertionError(f"{condition} is no effect")


def skill(
    name: str, parameters: tuple[Parameter, ...], pre: tuple[Requirement, ...], posts: tuple[Post, ...], seconds: float
) -> Skill:
    """Make a skill with one implementation, `plain`."""
    return Skill(
        name=name,
        parameters=parameters,
        pre=pre,
        post=posts,
        duration=Literal(seconds),
        implementations=("plain",),
        source=HERE,
    )


def library(*skills: Skill, vocabulary: Vocabulary = VOCABULARY) -> SkillLibrary:
    """Return a library of skills that each have one implementation."""
    plain = SkillLibrary(
        name="sample",
        namespace="https://w3id.org/skillc/library/sample#",
        hash="",
        vocabulary=vocabulary,
        skills={each.name: each for each in skills},
        implementations={f"{each.name}.plain": implementation(each) for each in skills},
    )
    return msgspec.structs.replace(plain, names=assign_names(plain))


def implementation(of: Skill) -> Implementation:
    """Return an implementation that adds nothing to the description."""
    return Implementation(
        name="plain",
        skill=of.name,
        parameters=of.parameters,
        pre=of.pre,
        hold=of.hold,
        post=of.post,
        duration=of.duration,
        body=Primitive("package.module:Class"),
        source=HERE,
    )


def property_is(variable: str, property_: str, value: bool | str) -> Compare:
    """Make the condition that a property has a value."""
    return Compare(PropertyOf(Variable(variable), iri(property_)), "==", Literal(value))


DRIVE = skill(
    "Drive",
    (parameter("robot", "Robot", "in"), parameter("to", "Location", "in"), parameter("from", "Location")),
    (requirement("here", holds("robot", "at", "from")),),
    (post(holds("robot", "at", "to")),),
    12.0,
)
PICK = skill(
    "Pick",
    (
        parameter("object", "Product", "in"),
        parameter("robot", "Robot"),
        parameter("arm", "Arm"),
        parameter("gripper", "Gripper"),
        parameter("from", "Location"),
    ),
    (
        requirement("mounted", holds("robot", "hasA", "arm")),
        requirement("has hand", holds("arm", "hasGripper", "gripper")),
        requirement("here", holds("robot", "at", "from")),
        requirement("there", holds("from", "contain", "object")),
        requirement("empty", Not(Holds(Variable("gripper"), iri("contain"), Anything()))),
        requirement("light", Compare(PropertyOf(Variable("object"), iri("weight")), "<", Literal(2.0))),
    ),
    (post(holds("gripper", "contain", "object")), post(Not(holds("from", "contain", "object")))),
    15.0,
)
CLEAN = skill(
    "Clean",
    (
        parameter("board", "Board", "in"),
        parameter("tool", "Eraser"),
        parameter("gripper", "Gripper"),
        parameter("robot", "Robot"),
        parameter("place", "Location"),
    ),
    (
        requirement("holding", holds("gripper", "contain", "tool")),
        requirement("here", holds("robot", "at", "place")),
        requirement("there", holds("place", "contain", "board")),
    ),
    (post(property_is("board", "isClean", True), sensed=True),),
    40.0,
)
WIPING = library(DRIVE, PICK, CLEAN)
LAB = WorldState.empty(VOCABULARY).with_changes(
    (
        *(individual(name, "Location") for name in ("dock", "shelf", "wall")),
        individual("robot", "Robot"),
        individual("arm", "CompliantArm"),
        individual("gripper", "WsgGripper"),
        individual("eraser", "Eraser"),
        individual("board", "Board"),
        fact_of("robot", "at", "dock"),
        fact_of("robot", "hasA", "arm"),
        fact_of("arm", "hasGripper", "gripper"),
        fact_of("shelf", "contain", "eraser"),
        fact_of("wall", "contain", "board"),
        SetProperty(iri("eraser"), iri("weight"), 0.1),
    )
)
CLEANED = Compare(PropertyOf(Individual(iri("board")), iri("isClean")), "==", Literal(True))
