"""Skills of flags and devices that scripted primitives run, and short makers of trees that call them."""

from __future__ import annotations

from itertools import count
from typing import Literal

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Assign, Compare, Condition, Expression, Individual, PropertyOf, Variable
from skillc_model.conditions import Literal as Constant
from skillc_model.skills import (
    Compound,
    Implementation,
    ImplementationBody,
    Let,
    Parameter,
    Post,
    Requirement,
    Skill,
    SkillLibrary,
)
from skillc_model.skills import Primitive as PrimitiveBody
from skillc_rdf.vocabulary.types import (
    ClassTerm,
    ClassType,
    FunctionTerm,
    ListType,
    PlainType,
    PropertyTerm,
    Vocabulary,
)
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE
from skillc_runtime.world.state.world_state import WorldState

NS = "http://example.org/stage#"
FLAG, DEVICE, ON = NS + "Flag", NS + "Device", NS + "on"
FLAGS = tuple(f"{NS}flag{number}" for number in range(3))
DEVICES = tuple(f"{NS}device{number}" for number in range(3))
SCRIPTED = "tree.stage:Scripted"
TEXT, BOOL = PlainType("Text"), PlainType("Bool")

_lines = count(1)


def here() -> Position:
    """Return a place no other node has."""
    return Position("stage.skill", next(_lines), 1)


def is_on(flag: Expression) -> Condition:
    """Return `flag.on == true`."""
    return Compare(PropertyOf(flag, ON), "==", Constant(True))


def parameter(name: str, type_: ClassType | PlainType, direction: Literal["in", "out", "opt"] = "in") -> Parameter:
    """Make a parameter."""
    return Parameter(name=name, direction=direction, type=type_, source=here())


def requirement(label: str, text: str, condition: Condition) -> Requirement:
    """Make a pre- or hold condition."""
    return Requirement(label=label, condition=condition, text=text, source=here())


NAME, THE_FLAG = parameter("name", TEXT), parameter("flag", ClassType(FLAG))
VALUE, THE_DEVICE = parameter("value", BOOL), parameter("device", ClassType(DEVICE))
WRITTEN = Post(
    label="written",
    condition=Compare(PropertyOf(Variable("flag"), ON), "==", Variable("value")),
    effects=(Assign(Variable("flag"), ON, Variable("value")),),
    sensed=False,
    text="flag.on == value",
    source=here(),
)
LIT = requirement("lit", "flag.on == true", is_on(Variable("flag")))
READY = requirement(
    "ready",
    "device.deviceState != Fault",
    Compare(PropertyOf(Variable("device"), DEVICE_STATE), "!=", Constant("Fault")),
)

VOCABULARY = Vocabulary(
    prefixes={"stage": NS},
    classes={iri: ClassTerm(iri=iri) for iri in (FLAG, DEVICE)},
    properties={
        ON: PropertyTerm(iri=ON, domains=(FLAG,), type=BOOL),
        DEVICE_STATE: PropertyTerm(iri=DEVICE_STATE, domains=(), type=TEXT),
    },
    functions={"names": FunctionTerm(name="names", parameters=(), result=ListType(TEXT), python="tree.library:names")},
)


def names(state: WorldState) -> list[str]:
    """A vocabulary function."""
    return ["a", "b", "c"]


def world() -> WorldModel:
    """Return a world of flags, all on, and devices."""
    flags = [change for iri in FLAGS for change in (AddIndividual(iri, (FLAG,)), SetProperty(iri, ON, True))]
    devices = [
        change for iri in DEVICES for change in (AddIndividual(iri, (DEVICE,)), SetProperty(iri, DEVICE_STATE, "Idle"))
    ]
    return WorldModel(WorldState.empty(VOCABULARY).with_changes([*flags, *devices]))


class Library:
    """Skills, added one by one; `python` is the class of every primitive."""

    def __init__(self, python: str = SCRIPTED) -> None:
        self._python = python
        self._skills: dict[str, Skill] = {}
        self._implementations: dict[str, Implementation] = {}
        name, flag, value, device = NAME, THE_FLAG, VALUE, THE_DEVICE
        self.add(Skill(name="Act", parameters=(name,), source=here()))
        self.add(Skill(name="Setup", parameters=(name,), scoped=True, source=here()))
        self.add(Skill(name="Kept", parameters=(name, flag), hold=(LIT,), source=here()))
        self.add(Skill(name="Lit", parameters=(name, flag), pre=(LIT,), source=here()))
        self.add(Skill(name="Set", parameters=(name, flag, value), post=(WRITTEN,), source=here()))
        self.add(Skill(name="Use", parameters=(name, device), uses=("device",), source=here()))
        self.add(Skill(name="Drive", parameters=(name, device), hold=(READY,), source=here()))
        self.add(Skill(name="Either", parameters=(name,), source=here()), count=2)
        self.add(Skill(name="Another", parameters=(name,), fallback=True, source=here()), count=2)

    def add(
        self, skill: Skill, body: ImplementationBody | None = None, count: int = 1, lets: tuple[Let, ...] = ()
    ) -> str:
        """Add a skill with so many equal implementations, scripted ones unless a body is given."""
        impls = tuple(f"way{number}" for number in range(count))
        for impl in impls:
            self._implementations[f"{skill.name}.{impl}"] = Implementation(
                name=impl,
                skill=skill.name,
                parameters=skill.parameters,
                pre=skill.pre,
                hold=skill.hold,
                post=skill.post,
                lets=lets,
                body=body or PrimitiveBody(self._python),
                source=here(),
            )
        values = {field: getattr(skill, field) for field in skill.__struct_fields__}
        self._skills[skill.name] = Skill(**(values | {"implementations": impls}))
        return skill.name

    def guarded(self, body: tree.Node) -> str:
        """Add a compound skill with a flag that must stay on."""
        skill = Skill(name=f"Guarded{len(self._skills)}", parameters=(THE_FLAG,), hold=(LIT,), source=here())
        return self.add(skill, Compound(body))

    def using(self, body: tree.Node) -> str:
        """Add a compound skill that locks a device."""
        skill = Skill(name=f"Using{len(self._skills)}", parameters=(THE_DEVICE,), uses=("device",), source=here())
        return self.add(skill, Compound(body))

    def build(self) -> SkillLibrary:
        """Return the library."""
        return SkillLibrary(
            name="stage",
            namespace="https://w3id.org/skillc/library/stage#",
            hash="",
            vocabulary=VOCABULARY,
            skills=dict(self._skills),
            implementations=dict(self._implementations),
        )


def call(skill: str, **arguments: str | bool) -> tree.Call:
    """Call a skill; text that is an IRI is an individual."""
    return tree.Call(
        skill=skill,
        implementation=None,
        arguments={name: _constant(value) for name, value in arguments.items()},
        out=None,
        source=here(),
    )


def act(name: str) -> tree.Call:
    """Call the plain scripted skill."""
    return call("Act", name=name)


def with_(name: str, child: tree.Node) -> tree.With:
    """Set something up around a child."""
    return tree.With(call=call("Setup", name=name), child=child, source=here())


def seq(*children: tree.Node, reactive: bool = False) -> tree.Sequence:
    """Make a sequence."""
    return tree.Sequence(children=children, reactive=reactive, source=here())


def sel(*children: tree.Node, reactive: bool = False) -> tree.Selector:
    """Make a selector."""
    return tree.Selector(children=children, reactive=reactive, source=here())


def par(policy: Literal["all", "any", "race", "lead"], *children: tree.Node) -> tree.Parallel:
    """Make a parallel node."""
    return tree.Parallel(policy=policy, children=children, source=here())


def check(flag: str) -> tree.Check:
    """Check that a flag is on."""
    return tree.Check(condition=is_on(Individual(flag)), text="on", source=here())


def _constant(value: str | bool) -> Expression:
    return Individual(value) if isinstance(value, str) and value.startswith(NS) else Constant(value)
