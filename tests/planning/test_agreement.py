"""Random small domains: every planner agrees with trying all skills in the world model itself."""

from __future__ import annotations

import random
from collections.abc import Iterator
from heapq import heappop, heappush
from itertools import count, product

import pytest

from planning.samples import library, post, skill
from skillc_compiler.library.conditions import (
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
from skillc_compiler.library.skills import Skill, SkillLibrary
from skillc_compiler.library.vocabulary import (
    ClassTerm,
    ClassType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    Signature,
    Vocabulary,
)
from skillc_runtime.planning.astar import AStar
from skillc_runtime.planning.choose import available
from skillc_runtime.planning.plan import Plan, PlanResult, Solved, Step, Unsolvable
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validate import PlanError, validate
from skillc_runtime.world.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.state import WorldState
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
LIMIT = 4000
Fact = tuple[str, str, str]


class Dice:
    """Draws domains, scenes and goals."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def literal(self, names: list[str], anything: bool) -> Condition:
        """Draw a relation or property of variables."""
        if self._random.random() < 0.7:
            sides = [Variable(self._random.choice(names)) for _ in range(2)]
            if anything and self._random.random() < 0.2:
                return Holds(sides[0], iri(self._random.choice(RELATIONS)), Anything())
            return Holds(sides[0], iri(self._random.choice(RELATIONS)), sides[1])
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
        names = list(INDIVIDUALS)
        facts = [
            AddRelation(
                iri(self._random.choice(names)), iri(self._random.choice(RELATIONS)), iri(self._random.choice(names))
            )
            for _ in range(self._random.randint(1, 6))
        ]
        values = [SetProperty(iri(name), iri("size"), n) for n, name in enumerate(names) if self._random.random() < 0.7]
        modes = [SetProperty(iri(name), iri("mode"), "c") for name in names if self._random.random() < 0.5]
        individuals = [AddIndividual(iri(name), (iri(cls),)) for name, cls in INDIVIDUALS.items()]
        return WorldState.empty(VOCABULARY).changed([*individuals, *facts, *values, *modes])

    def goal(self, skills: SkillLibrary, start: WorldState) -> Condition:
        """Draw a goal: any condition about two individuals or, more often, what is true after some random steps."""
        if self._random.random() < 0.25:
            goal = And((self.literal(["u", "v"], anything=True), self.condition(["u", "v"])))
            return Exists("u", iri("Item"), Exists("v", iri("Tool"), goal))
        state = start
        for _ in range(6):
            working = [after for step, _ in steps(skills, state) if (after := worked(step, skills, state))]
            state = self._random.choice(working) if working else state
        new = sorted(set(relations_of(state)) - set(relations_of(start)))
        gone = sorted(set(relations_of(start)) - set(relations_of(state)))
        parts: list[Condition] = [Holds(Individual(s), r, Individual(o)) for r, s, o in self.some(new)]
        parts += [Not(Holds(Individual(s), r, Individual(o))) for r, s, o in self.some(gone)]
        owner = PropertyOf(Individual(iri(self._random.choice(list(INDIVIDUALS)))), iri("mode"))
        return And((*parts, Not(Compare(owner, "==", Literal("b")))))

    def some(self, facts: list[Fact]) -> list[Fact]:
        """Draw up to two facts."""
        return self._random.sample(facts, min(len(facts), 2))


def relations_of(state: WorldState) -> Iterator[Fact]:
    """Yield every relation that holds."""
    yield from ((relation, *pair) for relation in state.facts for pair in state.pairs(relation))


def worked(step: Step, skills: SkillLibrary, state: WorldState) -> WorldState | None:
    """Return the world after a step, None where the step does not work."""
    try:
        return validate(Plan((step,), 0.0), skills, state, And(()))
    except PlanError:
        return None


def cheapest(skills: SkillLibrary, start: WorldState, goal: Condition) -> float | None:
    """Return the least cost of a sequence of skills that works in the world model; None when there is none."""
    ticket = count()
    queue = [(0.0, next(ticket), start)]
    seen: set[frozenset[object]] = set()
    while queue:
        cost, _, state = heappop(queue)
        key = frozenset(facts_of(state))
        if key in seen:
            continue
        seen.add(key)
        if evaluate(goal, state, {}):
            return cost
        if len(seen) > LIMIT:
            pytest.skip("too many states for trying everything")
        for step, seconds in steps(skills, state):
            after = worked(step, skills, state)
            if after is not None:
                heappush(queue, (cost + seconds, next(ticket), after))
    return None


def facts_of(state: WorldState) -> Iterator[object]:
    """Yield all that can change."""
    yield from relations_of(state)
    for property_, table in state.stored.items():
        yield from ((property_, *entry) for entry in table.items())


def steps(skills: SkillLibrary, state: WorldState) -> Iterator[tuple[Step, float]]:
    """Yield every skill with every type-correct choice of individuals."""
    for each in skills.skills.values():
        names = [one.name for one in each.parameters]
        types = [one.type.iri for one in each.parameters if isinstance(one.type, ClassType)]
        seconds = each.duration.value if isinstance(each.duration, Literal) else 0.0
        for chosen in product(*(sorted(state.instances(cls)) for cls in types)):
            yield Step(each.name, dict(zip(names, chosen, strict=True))), float(seconds)


def agrees(result: PlanResult, expected: float | None) -> bool:
    """Whether a planner's answer is the right one."""
    match result:
        case Solved(plan=plan, optimal="proven"):
            return expected is not None and abs(plan.duration_s - expected) < 1e-9
        case Unsolvable():
            return expected is None
        case _:
            return False


@pytest.mark.parametrize("seed", range(60))
def test_the_built_in_planner_finds_the_cheapest_plan(seed: int) -> None:
    dice = Dice(seed)
    skills = library(*(dice.skill(number) for number in range(3)), vocabulary=VOCABULARY)
    state = dice.scene()
    goal = dice.goal(skills, state)
    expected = cheapest(skills, state, goal)
    result = solve(skills, state, goal, (AStar(),))
    assert agrees(result, expected), (expected, result)


@pytest.mark.parametrize("seed", range(30))
def test_all_planners_agree(seed: int) -> None:
    if len(available()) == 1:
        pytest.skip("the planner is an extra")
    dice = Dice(1000 + seed)
    skills = library(*(dice.skill(number) for number in range(3)), vocabulary=VOCABULARY)
    state = dice.scene()
    goal = dice.goal(skills, state)
    own, other = solve(skills, state, goal, (AStar(),)), solve(skills, state, goal, available()[:1])
    assert agrees(other, own.plan.duration_s if isinstance(own, Solved) else None), (own, other)
