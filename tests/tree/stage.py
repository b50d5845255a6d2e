"""A cell without hardware and primitives that do what a script says, for tests of the tree engine."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import count
from typing import Literal

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
    Position,
    PropertyTerm,
    Vocabulary,
)
from skillc_runtime.control.watchdog import HeartbeatWatchdog
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

NS = "http://example.org/stage#"
FLAG, DEVICE, ON = NS + "Flag", NS + "Device", NS + "on"
FLAGS = tuple(f"{NS}flag{number}" for number in range(3))
DEVICES = tuple(f"{NS}device{number}" for number in range(2))
PERIOD_S = 0.1
SCRIPTED = "tree.stage:Scripted"
TEXT, BOOL = PlainType("Text"), PlainType("Bool")

_lines = count(1)

Ending = Literal["success", "fail", "crash", "refuse", "crash at start", "exit"]


@dataclass(frozen=True)
class Script:
    """What one run of a primitive does: so many ticks, the last of which ends it."""

    ending: Ending = "success"
    ticks: int = 1


@dataclass
class Stage:
    """A cell whose clock the test moves; `log` is what primitives were told, `scripts` what they shall do in turn.

    `away` are the primitives that do not come into contact when they approach.
    """

    world: WorldModel
    scripts: dict[str, list[Script]] = field(default_factory=dict)
    now: float = 0.0
    log: list[tuple[float, str, str]] = field(default_factory=list)
    starts: dict[str, int] = field(default_factory=dict)
    away: set[str] = field(default_factory=set)
    watchdog: HeartbeatWatchdog = field(default_factory=HeartbeatWatchdog)

    def camera(self) -> Stage:
        """Return what scripted primitives look at: the stage itself, of which a run shows them only the devices."""
        return self

    def next_script(self, name: str) -> Script:
        """Return what the next run under this name does; the scripts repeat, without any it succeeds at once."""
        scripts = self.scripts.get(name) or [Script()]
        number = self.starts.get(name, 0)
        self.starts[name] = number + 1
        return scripts[number % len(scripts)]

    def tell(self, what: str, name: str) -> None:
        """Note what a primitive was told."""
        self.log.append((self.now, what, name))

    def said(self, *kinds: str) -> list[str]:
        """Return the log without times, of these kinds only when some are given."""
        return [f"{what} {name}" for _, what, name in self.log if not kinds or what in kinds]


class Scripted(Primitive):
    """Does what the stage's script for its name says."""

    def __init__(self, cell: Stage, *, name: str, **rest: object) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self.stage = cell.camera()
        self.name = name
        self.script = self.stage.next_script(name)
        self.left = self.script.ticks

    def start(self) -> None:
        self.stage.tell("start", self.name)
        if self.script.ending == "refuse":
            raise SkillFailure(f"{self.name} refuses")
        if self.script.ending == "crash at start":
            raise RuntimeError(f"{self.name} broke")

    def tick(self) -> Status:
        self.stage.tell("tick", self.name)
        self.left -= 1
        if self.left > 0:
            return Status.RUNNING
        if self.script.ending == "fail":
            raise SkillFailure(f"{self.name} failed")
        if self.script.ending == "exit":
            raise SystemExit(0)
        if self.script.ending == "crash":
            raise RuntimeError(f"{self.name} broke")
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        self.stage.tell("halt", self.name)

    def pause(self) -> None:
        self.stage.tell("pause", self.name)

    def withdraw(self) -> None:
        self.stage.tell("withdraw", self.name)

    def approach(self) -> bool:
        self.stage.tell("approach", self.name)
        return self.name not in self.stage.away

    def resume(self) -> None:
        self.stage.tell("resume", self.name)

    def release(self) -> None:
        self.stage.tell("release", self.name)


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

VOCABULARY = Vocabulary(
    prefixes={"stage": NS},
    classes={iri: ClassTerm(iri=iri) for iri in (FLAG, DEVICE)},
    properties={ON: PropertyTerm(iri=ON, domains=(FLAG,), type=BOOL)},
    functions={"names": FunctionTerm(name="names", parameters=(), result=ListType(TEXT), python="tree.stage:names")},
)


def names(state: WorldState) -> list[str]:
    """A vocabulary function."""
    return ["a", "b", "c"]


def world() -> WorldModel:
    """Return a world of flags, all on, and devices."""
    flags = [change for iri in FLAGS for change in (AddIndividual(iri, (FLAG,)), SetProperty(iri, ON, True))]
    devices = [AddIndividual(iri, (DEVICE,)) for iri in DEVICES]
    return WorldModel(WorldState.empty(VOCABULARY).with_changes([*flags, *devices]))


def stage(**scripts: Script) -> Stage:
    """Return a stage on which each name does the same at every start."""
    return Stage(world(), {name: [script] for name, script in scripts.items()})


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
