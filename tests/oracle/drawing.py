"""Random small domains, scenes and goals, each drawn from a seed."""

from __future__ import annotations

import random
from collections.abc import Mapping

from oracle.forced import Fact, relations_of, steps, worked
from oracle.text import asked, compiled, condition_text, text_of
from planning.samples import post, skill
from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Forall,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.skills import Skill, SkillLibrary
from skillc_rdf.vocabulary.types import ClassTerm, PlainType, PropertyTerm, RelationTerm, Signature, Vocabulary
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState
from world.lab import NS, iri, parameter, requirement

RELATIONS = ("at", "holds", "heldBy", "linked", "touches", "grips")
ANY = (Signature(iri("Item"), iri("Item")),)
VOCABULARY = Vocabulary(
    prefixes={"t": NS},
    classes={
        iri("Item"): ClassTerm(iri=iri("Item")),
        iri("Place"): ClassTerm(iri=iri("Place"), parents=(iri("Item"),)),
        iri("Thing1"): ClassTerm(iri=iri("Thing1"), parents=(iri("Item"),)),
        iri("Tool"): ClassTerm(iri=iri("Tool"), parents=(iri("Thing1"),)),
    },
    relations={
        term.iri: term
        for term in (
            RelationTerm(iri=iri("at"), signatures=ANY, functional=True),
            RelationTerm(iri=iri("holds"), signatures=ANY, inverse_functional=True),
            RelationTerm(iri=iri("heldBy"), signatures=ANY, inverse=iri("holds")),
            RelationTerm(iri=iri("linked"), signatures=ANY, symmetric=True),
            RelationTerm(iri=iri("touches"), signatures=ANY),
            RelationTerm(iri=iri("grips"), signatures=ANY, parents=(iri("touches"),)),
        )
    },
    properties={
        iri("open"): PropertyTerm(iri=iri("open"), domains=(iri("Item"),), type=PlainType("Bool")),
        iri("mode"): PropertyTerm(
            iri=iri("mode"), domains=(iri("Item"),), type=PlainType("Text"), values=("a", "b", "c")
        ),
        iri("size"): PropertyTerm(iri=iri("size"), domains=(iri("Item"),), type=PlainType("Int")),
    },
)
INDIVIDUALS = {"p1": "Place", "p2": "Place", "o1": "Thing1", "o2": "Tool"}
CROWD = {**INDIVIDUALS, "p3": "Place", "o3": "Thing1", "o4": "Tool"}


class Dice:
    """Draws domains, scenes and goals."""

    vocabulary = VOCABULARY
    relations = RELATIONS

    def __init__(self, seed: int | str, individuals: Mapping[str, str] = INDIVIDUALS) -> None:
        self._random = random.Random(seed)
        self._individuals = individuals

    def library(self) -> SkillLibrary:
        """Draw three skills; they are written as text, which the compiler reads."""
        return compiled(text_of([self.skill(number) for number in range(3)]), VOCABULARY)

    def literal(self, names: list[str], anything: bool) -> Condition:
        """Draw a relation or property of variables."""
        if self._random.random() < 0.7:
            sides = [Variable(self._random.choice(names)) for _ in range(2)]
            if anything and self._random.random() < 0.2:
                return Holds(sides[0], iri(self._random.choice(self.relations)), Anything())
            return Holds(sides[0], iri(self._random.choice(self.relations)), sides[1])
        owner = Variable(self._random.choice(names))
        property_, value = self._random.choice([("open", True), ("open", False), ("mode", "a"), ("mode", "b")])
        return Compare(PropertyOf(owner, iri(property_)), "==", Literal(value))

    def condition(self, names: list[str], depth: int = 2) -> Condition:
        """Draw any condition over variables."""
        kind = self._random.randrange(12 if depth else 6)
        match kind:
            case 0 | 1 | 2:
                return self.literal(names, anything=True)
            case 3:
                return Not(self.literal(names, anything=True))
            case 4:
                owner = Variable(self._random.choice(names))
                if self._random.random() < 0.5:
                    return Compare(PropertyOf(owner, iri("size")), "<", Literal(2))
                return HasProperty(owner, iri(self._random.choice(["open", "mode", "size"])))
            case 5:
                one, other = (Variable(self._random.choice(names)) for _ in range(2))
                return self._random.choice([Not(Same(one, other)), IsA(one, iri("Tool")), Not(IsA(one, iri("Place")))])
            case 6 | 7:
                return Or((self.condition(names, depth - 1), self.condition(names, depth - 1)))
            case 8:
                return And((self.condition(names, depth - 1), self.condition(names, depth - 1)))
            case 9:
                return Not(self.condition(names, depth - 1))
            case _:
                quantifier = self._random.choice([Exists, Forall])
                cls = self._random.choice(["Item", "Place", "Thing1"])
                variable = f"x{depth}"
                return quantifier(variable, iri(cls), self.condition([*names, variable], depth - 1))

    def skill(self, number: int) -> Skill:
        """Draw a skill whose posts do not contradict each other."""
        names = [f"a{n}" for n in range(self._random.randint(1, 3))]
        classes = ["Item", "Place", "Thing1", "Tool"]
        parameters = tuple(parameter(name, self._random.choice(classes), "in") for name in names)
        depths = self._random.choice([(0,), (1,), (2,), (0, 1)])
        pre = tuple(requirement(f"pre{n}", self.condition(names, depth)) for n, depth in enumerate(depths))
        effect = self.literal(names, anything=False)
        posts = [post(effect)]
        if isinstance(effect, Holds) and self._random.random() < 0.3:
            posts = [post(Not(effect))]
        return skill(f"S{number}", parameters, pre, tuple(posts), float(self._random.randint(1, 5)))

    def scene(self) -> WorldState:
        """Draw the facts of a small world."""
        names = list(self._individuals)
        facts = [
            AddRelation(
                iri(self._random.choice(names)),
                iri(self._random.choice(self.relations)),
                iri(self._random.choice(names)),
            )
            for _ in range(self._random.randint(1, 6))
        ]
        values = [SetProperty(iri(name), iri("size"), n) for n, name in enumerate(names) if self._random.random() < 0.7]
        modes = [SetProperty(iri(name), iri("mode"), "c") for name in names if self._random.random() < 0.5]
        individuals = [AddIndividual(iri(name), (iri(cls),)) for name, cls in self._individuals.items()]
        return WorldState.empty(self.vocabulary).with_changes([*individuals, *facts, *values, *modes])

    def goal(self, skills: SkillLibrary, start: WorldState) -> Condition:
        """Draw a goal, which is written as text and read back."""
        return asked(condition_text(self._goal(skills, start)), start)

    def _goal(self, skills: SkillLibrary, start: WorldState) -> Condition:
        """Draw any condition about two individuals or, more often, what is true after some random steps."""
        if self._random.random() < 0.25:
            goal = And((self.literal(["u", "v"], anything=True), self.condition(["u", "v"])))
            return Exists("u", iri("Item"), Exists("v", iri("Tool"), goal))
        state = start
        for _ in range(6):
            working = [after for step in steps(skills, state) if (after := worked(step, skills, state))]
            state = self._random.choice(working) if working else state
        new = sorted(set(relations_of(state)) - set(relations_of(start)))
        gone = sorted(set(relations_of(start)) - set(relations_of(state)))
        parts: list[Condition] = [Holds(Individual(s), r, Individual(o)) for r, s, o in self.some(new)]
        parts += [Not(Holds(Individual(s), r, Individual(o))) for r, s, o in self.some(gone)]
        owner = PropertyOf(Individual(iri(self._random.choice(list(self._individuals)))), iri("mode"))
        return And((*parts, Not(Compare(owner, "==", Literal("b")))))

    def some(self, facts: list[Fact]) -> list[Fact]:
        """Draw up to two facts."""
        return self._random.sample(facts, min(len(facts), 2))
