"""The planning domain as typed data: what a planner can use of a library, and which skills are excluded and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import floor
from typing import TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Expression
from skillc_model.pddl.formulas import Change, Formula, Typed

ROOT = "thing"


class PlanningType(msgspec.Struct, frozen=True):
    """A class as a PDDL type below one parent; `depth` counts the types above it, `thing` excluded."""

    name: str
    parent: str
    cls: str
    depth: int


class RelationMeaning(msgspec.Struct, frozen=True):
    """True of (s, o) if `s relation o` follows from facts of relations that are not in `narrower`.

    `narrower` are the relations of other predicates as (relation, swapped). They change independently, so a condition
    on this relation reads their predicates too.
    """

    relation: str
    narrower: tuple[tuple[str, bool], ...] = ()


class PropertyMeaning(msgspec.Struct, frozen=True):
    """True of an individual whose property has the value: True of a Bool, one of the values of an enumerated text."""

    property: str
    value: bool | str


class ClassMeaning(msgspec.Struct, frozen=True):
    """True of the individuals of a class; never changes."""

    cls: str


class GuardMeaning(msgspec.Struct, frozen=True):
    """True of the individuals for which the condition holds in the initial world; it reads nothing a skill changes.

    `variables` are the free variables of the condition, in the order of the predicate's parameters. `text` is the
    labelled condition as its author wrote it, of which this one is the whole or a part.
    """

    variables: tuple[str, ...]
    condition: Condition
    skill: str
    label: str
    text: str


class GoalMeaning(msgspec.Struct, frozen=True):
    """True once the goal has been reached; false at first."""


class MovedMeaning(msgspec.Struct, frozen=True):
    """True of what a step has moved; false of all things at first."""


class ExclusionMeaning(msgspec.Struct, frozen=True):
    """True of the arguments (IRIs, in the order of the parameters) of steps that no plan may contain; never changes."""

    steps: tuple[tuple[str, ...], ...]


Meaning: TypeAlias = (
    RelationMeaning | PropertyMeaning | ClassMeaning | GuardMeaning | GoalMeaning | MovedMeaning | ExclusionMeaning
)


class Predicate(msgspec.Struct, frozen=True):
    """A predicate; its `meaning` determines its initial value; `changes` unless it is static."""

    name: str
    parameters: tuple[Typed, ...]
    meaning: Meaning
    changes: bool


class FixedCost(msgspec.Struct, frozen=True):
    """A duration, in seconds, that is the same for all arguments."""

    seconds: Fraction


class ComputedCost(msgspec.Struct, frozen=True):
    """The value of a cost function for these variables of the action."""

    function: str
    arguments: tuple[str, ...]


Cost: TypeAlias = FixedCost | ComputedCost


class CostFunction(msgspec.Struct, frozen=True):
    """A static function: `expression`, in seconds, in the initial world with `variables` bound to the arguments.

    `moving` is a property or relation (IRI) that the expression reads and skills change, so the value is an estimate.
    """

    name: str
    parameters: tuple[Typed, ...]
    variables: tuple[str, ...]
    expression: Expression
    skill: str
    moving: str | None = None


class Action(msgspec.Struct, frozen=True):
    """A planning action: a skill run by one of its implementations of equal duration.

    `binds` gives the skill parameter of each action parameter; `uses` are the variables of locked devices. A skill with
    outcomes has an action for each `outcome`, which is a label. A goal action (`skill` is None) costs nothing and does
    not become a step of a plan.
    """

    name: str
    skill: str | None
    parameters: tuple[Typed, ...]
    binds: tuple[str, ...]
    precondition: Formula
    hold: Formula
    effects: tuple[Change, ...]
    cost: Cost
    uses: tuple[str, ...] = ()
    doc: str = ""
    source: Position | None = None
    outcome: str = ""


class Excluded(msgspec.Struct, frozen=True):
    """A skill that no plan can contain, with the reason; `impossible` if it can never run successfully either.

    `numeric` if planners with numbers could plan it; `requirement` is the text of the condition that is the reason.
    """

    skill: str
    reason: str
    source: Position
    impossible: bool = False
    numeric: bool = False
    requirement: str = ""


@dataclass(frozen=True)
class PlanningDomain:
    """A planning domain; `names` maps PDDL names to IRIs and skills, `scale` is in cost units per second.

    Costs are exact fractions; planners get whole units, which are exact if the scale is a multiple of all
    denominators. `combined` are the sets of classes of individuals that have several.
    """

    name: str
    types: tuple[PlanningType, ...]
    predicates: tuple[Predicate, ...]
    costs: tuple[CostFunction, ...]
    actions: tuple[Action, ...]
    excluded: tuple[Excluded, ...]
    names: dict[str, str]
    scale: Fraction
    constants: tuple[Typed, ...] = ()
    combined: frozenset[frozenset[str]] = frozenset()

    @cached_property
    def _types(self) -> dict[str, PlanningType]:
        return {each.name: each for each in self.types}

    @cached_property
    def _by_class(self) -> dict[str, PlanningType]:
        return {each.cls: each for each in self.types}

    @cached_property
    def predicate(self) -> dict[str, Predicate]:
        """The predicates by name."""
        return {each.name: each for each in self.predicates}

    @cached_property
    def action(self) -> dict[str, Action]:
        """The actions by name."""
        return {each.name: each for each in self.actions}

    def units(self, seconds: Fraction) -> int:
        """Return a duration, in seconds, in whole cost units, rounded down if it is not a multiple of the unit."""
        return floor(seconds * self.scale)

    def type_of(self, classes: Iterable[str]) -> str:
        """Return the most specific type for an individual of these classes (IRIs); `thing` if none is known."""
        known = [self._by_class[cls] for cls in classes if cls in self._by_class]
        return min(known, key=lambda each: (-each.depth, each.name)).name if known else ROOT

    def is_a(self, type_name: str, ancestor: str) -> bool:
        """Whether every object of the type is one of `ancestor`."""
        while type_name not in (ancestor, ROOT):
            type_name = self._types[type_name].parent
        return type_name == ancestor or ancestor == ROOT

    def of_type(self, objects: Iterable[Typed], type_name: str) -> tuple[str, ...]:
        """Return the names of the objects of the type, in the given order."""
        fitting = {each.name for each in self.types if self.is_a(each.name, type_name)}
        if type_name == ROOT:
            fitting.add(ROOT)
        return tuple(each.name for each in objects if each.type in fitting)
