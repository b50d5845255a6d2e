"""Skills, their implementations and the tasks of a compiled library, with all names resolved and refinements merged."""

from __future__ import annotations

from typing import Literal as OneOf
from typing import TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import (
    Adjust,
    And,
    Anything,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Expression,
    Forall,
    ForEach,
    HasProperty,
    Holds,
    Not,
    Or,
    PropertyOf,
    wanted_by,
)
from skillc_model.properties import Property
from skillc_model.tree import Node
from skillc_rdf.vocabulary.types import ValueType, Vocabulary

FORMAT = 7
KEEP_S = 2.0
"""How long a paused tool goes on pressing, in s, if no running skill states it."""

PlanMeasure: TypeAlias = OneOf["work", "makespan", "cost"]
"""What a plan has little of: total duration of its steps, time until the last one ends, or total cost of its steps."""


class Parameter(msgspec.Struct, frozen=True, kw_only=True):
    """A parameter; `low` and `high` bound a number in SI units; `any_` allows several inferred values."""

    name: str
    direction: OneOf["in", "opt", "infer", "out"]
    type: ValueType
    any_: bool = msgspec.field(default=False, name="any")
    default: Expression | None = None
    low: float | None = None
    high: float | None = None
    doc: str = ""
    source: Position


class Requirement(msgspec.Struct, frozen=True, kw_only=True):
    """A pre- or hold condition; `text` is the condition as its author wrote it."""

    label: str
    condition: Condition
    text: str
    source: Position


class Post(msgspec.Struct, frozen=True, kw_only=True):
    """A postcondition with its effects; a sensed one is only checked, never written.

    What changes of numbers, and effects on each individual that fulfils a condition, have made so is no part of
    `condition`: it depends on the state before.
    """

    label: str
    condition: Condition
    effects: tuple[Effect, ...]
    sensed: bool
    text: str
    source: Position

    @property
    def achieved(self) -> Condition:
        """The condition under which its effects would change nothing."""
        done: list[Condition] = []
        for each in self.effects:
            if isinstance(each, ForEach):
                done.append(Forall(each.variable, each.cls, Or((Not(each.when), wanted_by(each.effect)))))
            elif isinstance(each, Adjust):
                done.append(wanted_by(each))
        return And((self.condition, *done)) if done else self.condition


class Outcome(msgspec.Struct, frozen=True, kw_only=True):
    """What can come of a skill, with its effects, and how likely that is, from 0 to 1.

    Exactly one outcome of a skill holds after it succeeded.
    """

    label: str
    condition: Condition
    effects: tuple[Effect, ...]
    likely: float
    text: str
    source: Position

    def find_possibility(self, senses: tuple[Condition, ...]) -> Condition:
        """Return under which condition it may come: what its skill `senses` is not known to be otherwise."""
        known: list[Condition] = []
        for each in self.effects:
            if isinstance(each, Assign) and HasProperty(each.subject, each.property) in senses:
                known.append(Not(Compare(PropertyOf(each.subject, each.property), "!=", each.value)))
            elif isinstance(each, Assert) and (has := Holds(each.subject, each.relation, Anything())) in senses:
                known.append(Or((Not(has), Holds(each.subject, each.relation, each.object))))
        return And(tuple(known))


class PausePolicy(msgspec.Struct, frozen=True):
    """Where a skill may be paused, and for how many seconds a paused tool goes on pressing before it is taken off.

    Anywhere: at any time; between steps: only before a call of its body starts; never: not while it runs. `keep_s` is
    None if the skill states no time: then others that run decide, else `KEEP_S`.
    """

    where: OneOf["anywhere", "between steps", "never"] = "anywhere"
    keep_s: float | None = None


class Skill(msgspec.Struct, frozen=True, kw_only=True):
    """A skill description. `implementations` are names in rank order; the first that is applicable is run.

    `possible` is what may be so after it and need not be; `senses` are the conditions that what it makes known is so,
    `outcomes` what can come of it.
    """

    name: str
    doc: str = ""
    parameters: tuple[Parameter, ...] = ()
    pre: tuple[Requirement, ...] = ()
    hold: tuple[Requirement, ...] = ()
    post: tuple[Post, ...] = ()
    possible: tuple[Requirement, ...] = ()
    senses: tuple[Condition, ...] = ()
    outcomes: tuple[Outcome, ...] = ()
    duration: Expression | None = None
    cost: Expression | None = None
    uses: tuple[str, ...] = ()
    shares: tuple[str, ...] = ()
    scoped: bool = False
    planned: bool = True
    fallback: bool = False
    endless: bool = False
    pause: PausePolicy = PausePolicy()
    implementations: tuple[str, ...] = ()
    source: Position

    @property
    def results(self) -> tuple[Post | Outcome, ...]:
        """What it says of the world after it: its postconditions, and what can come of it."""
        return (*self.post, *self.outcomes)

    def find_outcome(self, label: str) -> Outcome | None:
        """Return the outcome with a label; None if there is none, as for the empty label."""
        return next((each for each in self.outcomes if each.label == label), None)


class Compound(msgspec.Struct, frozen=True, tag="compound"):
    """A body of nodes."""

    node: Node


class Primitive(msgspec.Struct, frozen=True, tag="primitive"):
    """A body in Python, "module:Class"."""

    python: str


class Declared(msgspec.Struct, frozen=True, tag="declared"):
    """No body: the implementation takes its duration, and what it declares is so then. Only symbolic cells run it."""


ImplementationBody: TypeAlias = Compound | Primitive | Declared


class Let(msgspec.Struct, frozen=True):
    """A named value, computed when the implementation starts."""

    name: str
    value: Expression


class Implementation(msgspec.Struct, frozen=True, kw_only=True):
    """An implementation of a skill, with the parameters and conditions of the description refined and its own added.

    `outputs` are those whose values are computed when it has ended.
    """

    name: str
    skill: str
    doc: str = ""
    parameters: tuple[Parameter, ...] = ()
    pre: tuple[Requirement, ...] = ()
    hold: tuple[Requirement, ...] = ()
    post: tuple[Post, ...] = ()
    duration: Expression | None = None
    prefer: float = 0.0
    lets: tuple[Let, ...] = ()
    outputs: tuple[Let, ...] = ()
    body: ImplementationBody
    verify: tuple[Property, ...] = ()
    source: Position


class Task(msgspec.Struct, frozen=True, kw_only=True):
    """A scene with either a goal to plan for or a body to run; `parameters` occur in these as variables.

    `scene` is a path relative to the task's file, or the name of a shipped scene. `backend` is where it runs, None for
    where tasks of its project run; `within_s` for how long it may go on, in s; `minimise` of what its
    plan has little, None for what plans of its project have little of. What holds `always` neither plan nor run break.
    """

    name: str
    doc: str = ""
    parameters: tuple[Parameter, ...] = ()
    scene: str | None = None
    goal: Condition | None = None
    goal_text: str = ""
    body: Node | None = None
    backend: str | None = None
    within_s: float | None = None
    minimise: PlanMeasure | None = None
    always: tuple[Condition, ...] = ()
    source: Position


class TaskPart(msgspec.Struct, frozen=True, kw_only=True):
    """One of several tasks that are planned and run as one: its goal, and within which time in s it is to hold."""

    name: str
    goal: Condition
    within_s: float | None = None


class Expectation(msgspec.Struct, frozen=True, kw_only=True):
    """What is expected at the end of a test: a condition, a failure with a text in its reason, or else no plan.

    `text` is the condition as its author wrote it.
    """

    condition: Condition | None = None
    failure: str | None = None
    text: str = ""
    source: Position

    @property
    def is_no_plan(self) -> bool:
        """Whether there shall be no plan."""
        return self.condition is None and self.failure is None


class Test(Task, frozen=True, kw_only=True):
    """A task that starts after `starts`, as changes of the facts of its scene, and what is expected of it.

    `outcomes` are the labels of what comes of skills, by the name of the skill.
    """

    starts: tuple[Effect, ...] = ()
    outcomes: dict[str, str] = {}
    expects: tuple[Expectation, ...] = ()


class SkillLibrary(msgspec.Struct, frozen=True, kw_only=True):
    """A compiled library: the content of library.json, which is all that the runtime loads.

    `format` increases with every change to the meaning of the JSON; `namespace` is that of the terms it declares;
    `uses` are the namespaces whose terms its files write by bare names;
    `implementations` is keyed by `Skill.name`; `hash` is the hash of the sources; `names` maps each PDDL name to its
    IRI or skill.
    """

    format: int = FORMAT
    name: str
    namespace: str
    uses: tuple[str, ...] = ()
    hash: str
    vocabulary: Vocabulary
    skills: dict[str, Skill] = {}
    implementations: dict[str, Implementation] = {}
    tasks: dict[str, Task] = {}
    tests: dict[str, Test] = {}
    names: dict[str, str] = {}

    def implementations_of(self, skill: str) -> tuple[Implementation, ...]:
        """Return a skill's implementations in rank order."""
        return tuple(self.implementations[f"{skill}.{name}"] for name in self.skills[skill].implementations)
