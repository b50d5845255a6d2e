"""Random planning domains with everything that a skill may hold, as text; their scenes and goals."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from random import Random

import msgspec

from oracle.drawing import RELATIONS, VOCABULARY, Dice
from oracle.forced import steps, worked
from oracle.text import Contradictory, asked, condition_text
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.conditions import And, Anything, Compare, Condition, Holds, Individual, Not, PropertyOf
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import RelationTerm, Signature
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.world_state import WorldState
from world.lab import iri

INDIVIDUALS: Mapping[str, tuple[str, ...]] = {
    "p1": ("Place",),
    "p2": ("Place",),
    "o1": ("Thing1",),
    "o2": ("Tool",),
    "b1": ("Tool", "Place"),
}
_ANY = (Signature(iri("Item"), iri("Item")),)
_MORE = (
    RelationTerm(iri=iri("on"), signatures=_ANY, functional=True, inverse_functional=True),
    RelationTerm(iri=iri("under"), signatures=_ANY, inverse=iri("on")),
    RelationTerm(iri=iri("within"), signatures=_ANY, transitive=True),
    RelationTerm(iri=iri("beside"), signatures=_ANY, irreflexive=True, functional=True),
    RelationTerm(iri=iri("before"), signatures=_ANY, asymmetric=True),
    RelationTerm(iri=iri("kept"), signatures=(Signature(iri("Tool"), iri("Place")),), parents=(iri("at"),)),
)
_CLASSES = ("Item", "Place", "Thing1", "Tool")
_NARROWER = {"Item": ("Place", "Thing1", "Tool"), "Thing1": ("Tool",)}
_NUMBERS = ("1 s", "2 s", "1.04 s", "1.06 s", "0.26 s", "0.14 s", "3.333 s", "0.1 s + 0.2 s", "1 s / 3", "0 s")
TRIES = 200


class Domains(Dice):
    """Draws domains, scenes and goals."""

    vocabulary = msgspec.structs.replace(VOCABULARY, relations={**VOCABULARY.relations, **{t.iri: t for t in _MORE}})
    relations = (*RELATIONS, "on", "under", "within", "beside", "before", "kept")

    def __init__(self, random: Random) -> None:
        self._random = random
        names = ["p1", "o1", "o2", *random.sample(["p2", "b1"], random.randint(0, 2))]
        self._typed = {name: INDIVIDUALS[name] for name in names}
        self._individuals = {name: classes[0] for name, classes in self._typed.items()}

    def domain(self) -> tuple[str, SkillLibrary, WorldState]:
        """Draw a library, as text and compiled, and a scene, in which mostly some skill can do something."""
        for _ in range(TRIES):
            text, library = self.text()
            state = self.scene()
            if self._chance(0.1) or any(worked(each, library, state) for each in steps(library, state)):
                break
        return text, library, state

    def text(self) -> tuple[str, SkillLibrary]:
        """Draw a library that the compiler accepts, as text and compiled."""
        for _ in range(TRIES):
            skills = ["\n".join(self._skill(number)) for number in range(3)]
            skills += [self._rival(each) for each in skills if self._chance(0.2)]
            text = "\n".join(["use t", *skills])
            outcome = compile([Source("random.skill", text)], self.vocabulary, {}, "random")
            if not any(each.severity == "error" for each in outcome.diagnostics):
                return text, outcome.value
        raise AssertionError(f"none of {TRIES} libraries was accepted")

    def goal(self, skills: SkillLibrary, start: WorldState) -> Condition:
        """Draw a goal that the compiler accepts, which has something to be done more often than not."""
        for _ in range(TRIES):
            goal = self._goal(skills, start)
            if self._chance(0.25):
                goal = And((goal, self._open()))
            try:
                asked_for = asked(condition_text(goal), start)
            except (Contradictory, AssertionError):
                continue
            if not evaluate(asked_for, start, {}) or self._chance(0.1):
                return asked_for
        return And(())

    def _open(self) -> Condition:
        """Draw a condition about whoever stands in a relation to an individual, or nobody."""
        known = Individual(iri(self._random.choice(list(self._typed))))
        sides = (known, Anything()) if self._chance(0.5) else (Anything(), known)
        holds = Holds(sides[0], iri(self._random.choice(RELATIONS)), sides[1])
        return Not(holds) if self._chance(0.5) else holds

    def scene(self) -> WorldState:
        """Draw the facts of a small world that breaks no axiom."""
        people = [AddIndividual(iri(name), tuple(map(iri, classes))) for name, classes in self._typed.items()]
        model = WorldModel(WorldState.empty(self.vocabulary).with_changes(people))
        names = list(self._typed)
        for _ in range(self._random.randint(1, 6)):
            subject, object_ = self._random.choice(names), self._random.choice(names)
            with suppress(WorldError):
                model.commit((AddRelation(iri(subject), iri(self._random.choice(self.relations)), iri(object_)),))
        sizes = [SetProperty(iri(name), iri("size"), n) for n, name in enumerate(names) if self._random.random() < 0.8]
        modes = [SetProperty(iri(name), iri("mode"), "c") for name in names if self._random.random() < 0.5]
        return model.snapshot().with_changes([*sizes, *modes])

    def literal(self, names: list[str], anything: bool) -> Condition:
        """Draw a relation or property, mostly of variables, else of an individual that the scene may lack."""
        drawn = super().literal(names, anything)
        if not self._chance(0.2):
            return drawn
        known = Individual(iri(self._random.choice(list(INDIVIDUALS))))
        match drawn:
            case Holds():
                return msgspec.structs.replace(drawn, **{self._random.choice(["subject", "object"]): known})
            case Compare(left=PropertyOf() as read):
                return msgspec.structs.replace(drawn, left=msgspec.structs.replace(read, of=known))
            case _:
                return drawn

    def _skill(self, number: int) -> Iterator[str]:
        names = [f"a{n}" for n in range(self._random.randint(1, 3))]
        types = {name: self._random.choice(_CLASSES) for name in names}
        yield f"skill S{number} {{"
        for position, name in enumerate(names):
            direction = "infer" if position and self._chance(0.3) else "in"
            yield f"    {direction} {name}: {types[name]}"
        optional = self._chance(0.2)
        if optional:
            yield "    opt factor: Int = 2"
        if self._chance(0.1):
            yield f"    opt spare: {self._random.choice(_CLASSES)} = t:{self._random.choice(list(INDIVIDUALS))}"
            names = [*names, "spare"]
        for position in range(self._random.randint(1, 2)):
            yield f"    pre p{position}: {self._condition(names)}"
        if self._chance(0.25):
            yield f"    hold h: {condition_text(self.literal(names, anything=True))}"
        yield from (f"    post {each}" for each in self._posts(names))
        if self._chance(0.8):
            yield f"    duration {self._duration(names, optional)}"
        if self._chance(0.2):
            yield f"    uses {names[0]}"
        yield "}"
        for index in range(self._random.choice([1, 1, 2, 3])):
            yield from self._implementation(number, index, types, optional)

    def _rival(self, skill: str) -> str:
        """Return a skill for the same, of which the durations are others."""
        rival = re.sub(r"\bS(\d)\b", r"Rival\1", skill)
        return re.sub(r"duration .*", lambda _: f"duration {self._random.choice(_NUMBERS)}", rival)

    def _implementation(self, number: int, index: int, types: Mapping[str, str], optional: bool) -> Iterator[str]:
        names = list(types)
        yield f"impl way{index} of S{number} {{"
        name = self._random.choice(names)
        if index and types[name] in _NARROWER and self._chance(0.5):
            yield f"    refine {name}: {self._random.choice(_NARROWER[types[name]])}"
        if index and self._chance(0.5):
            yield f"    pre own{index}: {self._condition(names)}"
        if self._chance(0.15):
            yield f"    hold kept{index}: {condition_text(self.literal(names, anything=True))}"
        if self._chance(0.6):
            yield f"    duration {self._duration(names, optional)}"
        if self._chance(0.2):
            yield f"    prefer {self._random.randint(1, 3)}"
        yield '    run python "package.module:Class"'
        yield "}"

    def _condition(self, names: list[str]) -> str:
        condition = self.condition(names, self._random.choice([0, 1, 2]))
        if self._chance(0.1):
            return f"({condition_text(self.literal(names, True))}) implies ({condition_text(condition)})"
        return condition_text(condition)

    def _posts(self, names: list[str]) -> Iterator[str]:
        """Yield one to three effects that do not contradict each other in a way that can be seen."""
        read: set[object] = set()
        for _ in range(self._random.choice([1, 1, 2, 3])):
            effect = self.literal(names, anything=False)
            key = effect.relation if isinstance(effect, Holds) else str(effect)
            if key in read:
                continue
            read.add(key)
            positive = not isinstance(effect, Holds) or self._chance(0.75)
            yield condition_text(effect if positive else Not(effect), outside=True)

    def _duration(self, names: list[str], optional: bool) -> str:
        """Draw a duration: with decimals, nothing at all, or what depends on things."""
        number = self._random.choice(_NUMBERS)
        match self._random.randrange(6):
            case 0:
                return f"{number} + {self._random.choice(names)}.size * 0.7 s"
            case 1 if self._chance(0.3):
                return f"{number} + t:{self._random.choice(list(INDIVIDUALS))}.size * 0.7 s"
            case 1 if optional:
                return f"factor * ({number})"
            case _:
                return number

    def _chance(self, share: float) -> bool:
        return self._random.random() < share
