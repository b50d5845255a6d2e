"""A small library written by hand: a mobile arm fetches an eraser and wipes a board."""

from __future__ import annotations

from functools import cache

from skillc_dsl.position import Position
from skillc_model.conditions import (
    Anything,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Holds,
    Literal,
    Not,
    PropertyOf,
    Retract,
    Variable,
)
from skillc_model.pddl.names import assign_names
from skillc_model.skills import (
    Implementation,
    Parameter,
    PausePolicy,
    Post,
    Primitive,
    Requirement,
    Skill,
    SkillLibrary,
)
from skillc_rdf.vocabulary.types import (
    ClassTerm,
    ClassType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    Signature,
    Vocabulary,
)

BASE = "http://example.org/core#"
HERE = Position("sample.skill", 1, 1)


def iri(name: str) -> str:
    return BASE + name


def cls(name: str, *parents: str) -> ClassTerm:
    return ClassTerm(iri=iri(name), parents=tuple(iri(each) for each in parents), source=HERE)


def relation(name: str, domain: str, range_: str, *parents: str, **axioms: bool) -> RelationTerm:
    signature = Signature(iri(domain), iri(range_))
    return RelationTerm(iri=iri(name), signatures=(signature,), parents=tuple(map(iri, parents)), source=HERE, **axioms)


CLASSES = (
    cls("Item"),
    cls("Holder", "Item"),
    cls("Device", "Item"),
    cls("Place", "Holder"),
    cls("Robot", "Device", "Holder"),
    cls("MobileRobot", "Robot"),
    cls("Arm", "Device", "Holder"),
    cls("CompliantArm", "Arm"),
    cls("Gripper", "Device", "Holder"),
    cls("Product", "Item"),
    cls("Eraser", "Product"),
    cls("Surface", "Item"),
)
RELATIONS = (
    relation("at", "Robot", "Place", functional=True),
    relation("contain", "Holder", "Item", "holdsDeep", inverse_functional=True, asymmetric=True),
    relation("containedIn", "Item", "Holder", functional=True),
    relation("hasA", "Item", "Item", "holdsDeep", inverse_functional=True),
    relation("hasGripper", "Arm", "Gripper", "hasA", functional=True),
    relation("holdsDeep", "Item", "Item", transitive=True),
)
PROPERTIES = (
    PropertyTerm(iri=iri("deviceState"), domains=(iri("Device"),), type=PlainType("Text"), values=("Idle", "Fault")),
    PropertyTerm(iri=iri("isClean"), domains=(iri("Surface"),), type=PlainType("Bool")),
    PropertyTerm(iri=iri("weight"), domains=(iri("Item"),), type=NumberType("Mass")),
    PropertyTerm(iri=iri("mode"), domains=(iri("Arm"),), type=PlainType("Text"), values=("Stiff", "Soft")),
)


@cache
def vocabulary() -> Vocabulary:
    relations = {each.iri: each for each in RELATIONS}
    inverse = RelationTerm(
        iri=iri("contain"),
        signatures=relations[iri("contain")].signatures,
        parents=(iri("holdsDeep"),),
        inverse=iri("containedIn"),
        inverse_functional=True,
        asymmetric=True,
        source=HERE,
    )
    return Vocabulary(
        prefixes={"core": BASE},
        classes={each.iri: each for each in CLASSES},
        relations=relations | {inverse.iri: inverse},
        properties={each.iri: each for each in PROPERTIES},
    )


def parameter(name: str, type_: str, direction: str = "in") -> Parameter:
    return Parameter(name=name, direction=direction, type=ClassType(iri(type_)), source=HERE)  # type: ignore[arg-type]


def number(name: str, direction: str = "opt", default: float | None = None) -> Parameter:
    value = None if default is None else Literal(default)
    return Parameter(name=name, direction=direction, type=NumberType("Mass"), default=value, source=HERE)  # type: ignore[arg-type]


def term(name: str) -> Variable | Anything:
    return Anything() if name == "_" else Variable(name)


def holds(text: str) -> Holds:
    subject, verb, object_ = text.split()
    return Holds(term(subject), iri(verb), term(object_))


def read(subject: str, name: str) -> PropertyOf:
    return PropertyOf(Variable(subject), iri(name))


def need(label: str, condition: Condition, text: str = "") -> Requirement:
    return Requirement(label=label, condition=condition, text=text or label, source=HERE)


def post(label: str, text: str, *, positive: bool = True) -> Post:
    condition = holds(text)
    effect: Effect = Retract(condition.subject, condition.relation, condition.object)
    if positive:
        effect = Assert(condition.subject, condition.relation, condition.object)  # type: ignore[arg-type]
    meaning = condition if positive else Not(condition)
    shown = text if positive else f"not {text}"
    return Post(label=label, condition=meaning, effects=(effect,), sensed=False, text=shown, source=HERE)


def assign(label: str, subject: str, name: str, value: bool | str | float, *, sensed: bool = False) -> Post:
    condition = Compare(read(subject, name), "==", Literal(value))
    effect = Assign(Variable(subject), iri(name), Literal(value))
    text = f"{subject}.{name} == {str(value).lower()}"
    return Post(label=label, condition=condition, effects=(effect,), sensed=sensed, text=text, source=HERE)


def implementation(skill: Skill, name: str, *own: Requirement, **refined: str) -> Implementation:
    parameters = tuple(
        parameter(each.name, refined[each.name], each.direction) if each.name in refined else each
        for each in skill.parameters
    )
    return Implementation(
        name=name,
        skill=skill.name,
        parameters=parameters,
        pre=(*skill.pre, *own),
        hold=skill.hold,
        post=skill.post,
        duration=skill.duration,
        body=Primitive("package.module:Class"),
        source=HERE,
    )


READY = need("ready", Compare(read("arm", "deviceState"), "!=", Literal("Fault")), "arm.deviceState != Fault")

DRIVE = Skill(
    name="Drive",
    doc="Drive to `to`, wherever the robot is.",
    parameters=(parameter("robot", "MobileRobot"), parameter("to", "Place"), parameter("from", "Place", "infer")),
    pre=(need("here", holds("robot at from"), "robot at from"),),
    post=(post("there", "robot at to"),),
    duration=Literal(12.0),
    uses=("robot",),
    implementations=("straight",),
    source=HERE,
)
PICK = Skill(
    name="Pick",
    doc="Take `object` out of its place.",
    parameters=(
        parameter("arm", "Arm"),
        parameter("object", "Product"),
        parameter("robot", "Robot", "infer"),
        parameter("gripper", "Gripper", "infer"),
        parameter("from", "Place", "infer"),
        number("limit", default=2.0),
    ),
    pre=(
        need("on", holds("robot hasA arm"), "robot hasA arm"),
        need("mounted", holds("arm hasA gripper"), "arm hasA gripper"),
        need("here", holds("robot at from"), "robot at from"),
        need("there", holds("from contain object"), "from contain object"),
        need("empty", Not(holds("gripper contain _")), "not gripper contain _"),
        need("light", Compare(read("object", "weight"), "<=", Variable("limit")), "object.weight <= limit"),
    ),
    hold=(READY,),
    post=(post("held", "gripper contain object"), post("gone", "from contain object", positive=False)),
    duration=Literal(15.0),
    pause=PausePolicy("between steps", 0.5),
    uses=("arm",),
    implementations=("close",),
    source=HERE,
)
WIPE = Skill(
    name="Wipe",
    parameters=(
        parameter("surface", "Surface"),
        parameter("arm", "Arm", "infer"),
        parameter("gripper", "Gripper", "infer"),
        parameter("tool", "Eraser", "infer"),
        parameter("robot", "Robot", "infer"),
        parameter("station", "Place", "infer"),
    ),
    pre=(
        need("on", holds("robot hasA arm")),
        need("mounted", holds("arm hasA gripper")),
        need("here", holds("robot at station")),
        need("there", holds("station contain surface")),
    ),
    hold=(READY, need("kept", holds("gripper contain tool"), "gripper contain tool")),
    post=(assign("clean", "surface", "isClean", True, sensed=True),),
    duration=Literal(40.0),
    uses=("arm",),
    implementations=("lanes",),
    source=HERE,
)


def library(*skills: Skill, implementations: tuple[Implementation, ...] = ()) -> SkillLibrary:
    """Return a library of these skills; a skill without implementation among those given gets a plain one."""
    known = {each.skill for each in implementations}
    plain = tuple(
        implementation(skill, name) for skill in skills if skill.name not in known for name in skill.implementations
    )
    bare = SkillLibrary(
        name="sample",
        namespace="https://w3id.org/skillc/library/sample#",
        hash="0123abcd",
        vocabulary=vocabulary(),
        skills={each.name: each for each in skills},
        implementations={f"{each.skill}.{each.name}": each for each in (*implementations, *plain)},
    )
    return SkillLibrary(
        **{name: getattr(bare, name) for name in bare.__struct_fields__} | {"names": assign_names(bare)}
    )


def wiping() -> SkillLibrary:
    """Return the library of all three skills; wiping needs a compliant arm."""
    return library(DRIVE, PICK, WIPE, implementations=(implementation(WIPE, "lanes", arm="CompliantArm"),))
