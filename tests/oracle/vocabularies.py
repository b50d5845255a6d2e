"""Random vocabularies with axioms, skills that name individuals, and scenes that obey the axioms; each from a seed."""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator
from dataclasses import dataclass

import msgspec

from oracle.forced import Fact, relations_of, steps, worked
from planning.samples import implementation, post, skill
from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Forall,
    Holds,
    Individual,
    Literal,
    Not,
    Or,
    PropertyOf,
    Term,
    Variable,
)
from skillc_model.pddl.names import assign_names
from skillc_model.skills import Implementation, Parameter, Skill, SkillLibrary
from skillc_rdf.vocabulary.types import (
    ClassTerm,
    ClassType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    Signature,
    Vocabulary,
    local_name,
)
from skillc_runtime.world.state.changes import AddIndividual, AddRelation
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.world_state import WorldState
from world.lab import NS, iri, parameter, requirement

CLASSES = {
    "Item": (),
    "Place": ("Item",),
    "Box": ("Item",),
    "Tool": ("Item",),
    "Shelf": ("Place",),
    "Crate": ("Box", "Place"),
    "Knife": ("Tool",),
}
AXIOMS = ("functional", "inverse_functional", "symmetric", "asymmetric", "irreflexive")
RELATIONS = ("r1", "r2", "r3", "r4")


@dataclass(frozen=True)
class Drawn:
    """Skills with the scene and the goal that they are to be planned for; the compiler would refuse some of them."""

    library: SkillLibrary
    state: WorldState
    goal: Condition


class Author:
    """Draws a vocabulary, and skills, scenes and goals in its words."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._signatures: dict[str, tuple[Signature, ...]] = {}
        self._classes = {
            iri(name): ClassTerm(iri=iri(name), parents=tuple(map(iri, parents))) for name, parents in CLASSES.items()
        }
        self.vocabulary = Vocabulary(
            prefixes={"t": NS},
            classes=self._classes,
            relations={each.iri: each for each in self._relations()},
            properties={
                iri("open"): PropertyTerm(iri=iri("open"), domains=(iri(self._side_class()),), type=PlainType("Bool")),
                iri("mode"): PropertyTerm(
                    iri=iri("mode"), domains=(iri("Item"),), type=PlainType("Text"), values=("a", "b", "c")
                ),
            },
        )
        self._of: dict[str, str] = {}
        self.individuals = {"p1": "Place", "b1": "Box", "x1": self._any_class(), "x2": self._any_class()}

    def drawn(self) -> Drawn:
        """Draw skills, a scene and a goal."""
        skills = [self._skill(number) for number in range(self._random.randint(2, 3))]
        ways = [way for each in skills for way in self._implementations(each)]
        plain = SkillLibrary(
            name="random",
            namespace="https://w3id.org/skillc/library/random#",
            hash="",
            vocabulary=self.vocabulary,
            skills={each.name: each for each in skills},
            implementations={f"{each.skill}.{each.name}": each for each in ways},
        )
        library = msgspec.structs.replace(plain, names=assign_names(plain))
        state = self._scene()
        return Drawn(library, state, self._goal(library, state))

    def _any_class(self) -> str:
        return self._random.choice(list(CLASSES))

    def _side_class(self) -> str:
        return self._any_class() if self._maybe(0.2) else "Item"

    def _maybe(self, chance: float) -> bool:
        return self._random.random() < chance

    def _relations(self) -> Iterator[RelationTerm]:
        for number, name in enumerate(RELATIONS):
            above = self._random.choice(RELATIONS[:number]) if number and self._maybe(0.5) else None
            inverse = self._random.choice(RELATIONS[:number]) if number and self._maybe(0.25) else None
            axioms = {axiom: self._maybe(0.12) for axiom in AXIOMS}
            above_it = self._signatures.get(above or "") if self._maybe(0.8) else None
            signatures = above_it or tuple(
                Signature(iri(self._side_class()), iri(self._side_class()))
                for _ in range(self._random.choice((1, 1, 2)))
            )
            self._signatures[name] = tuple(map(self._narrowed, signatures))
            yield RelationTerm(
                iri=iri(name),
                signatures=self._signatures[name],
                parents=(iri(above),) if above else (),
                inverse=iri(inverse) if inverse else None,
                transitive=self._maybe(0.04),
                **axioms,
            )

    def _implementations(self, of: Skill) -> Iterator[Implementation]:
        """Yield implementations; those of a skill with two demand something of their own."""
        if "special" not in of.implementations:
            yield implementation(of)
            return
        self._of = {each.name: each.type.iri for each in of.parameters}  # type: ignore[union-attr]
        for name in of.implementations:
            terms: list[Term] = [Variable(each.name) for each in of.parameters]
            own = (requirement(f"own-{name}", self._condition(terms, 1)),) if self._maybe(0.5) else ()
            made = msgspec.structs.replace(implementation(of), name=name, pre=(*of.pre, *own))
            yield msgspec.structs.replace(made, parameters=tuple(self._refined(each) for each in of.parameters))

    def _refined(self, of: Parameter) -> Parameter:
        if of.direction == "opt" and self._maybe(0.2):
            return msgspec.structs.replace(of, default=Individual(iri(self._random.choice(list(self.individuals)))))
        narrower = [cls for cls in CLASSES if self.vocabulary.is_a(iri(cls), of.type.iri)]  # type: ignore[union-attr]
        return msgspec.structs.replace(of, type=ClassType(iri(self._random.choice(narrower))))

    def _narrowed(self, signature: Signature) -> Signature:
        return Signature(
            *(self._below(each) if self._maybe(0.3) else each for each in (signature.domain, signature.range))
        )

    def _below(self, cls: str) -> str:
        below = [each for each in CLASSES if any(cls == iri(above) for above in (each, *CLASSES[each]))]
        return iri(self._random.choice(below))

    def _skill(self, number: int) -> Skill:
        parameters = tuple(parameter(f"a{n}", self._any_class(), "in") for n in range(self._random.randint(1, 3)))
        if self._maybe(0.3):
            parameters = (*parameters, self._optional())
        self._of = {each.name: each.type.iri for each in parameters}  # type: ignore[union-attr]
        terms: list[Term] = [Variable(each.name) for each in parameters]
        pre = tuple(requirement(f"pre{n}", self._condition(terms, 1)) for n in range(self._random.randint(0, 1)))
        posts = tuple(map(post, self._posts(terms)))
        made = skill(f"S{number}", parameters, pre, posts, float(self._random.randint(1, 5)))
        return msgspec.structs.replace(made, implementations=("special", "plain")) if self._maybe(0.3) else made

    def _optional(self) -> Parameter:
        name = self._random.choice(list(self.individuals))
        made = parameter("o", self.individuals[name], "opt")
        return msgspec.structs.replace(made, default=Individual(iri(name)))

    def _posts(self, terms: list[Term]) -> Iterator[Condition]:
        for _ in range(self._random.choice((1, 1, 2, 3))):
            literal = self._literal(terms, anything=False)
            denied = isinstance(literal, Holds) and self._maybe(0.3)
            yield Not(literal) if denied else literal

    def _term(self, terms: list[Term], classes: Collection[str]) -> Term:
        """Draw a term, mostly one that is of one of the classes."""
        named: list[Term] = [Individual(iri(name)) for name in self.individuals]
        chosen = named if self._maybe(0.25) else terms
        fitting = [each for each in chosen if self._is_a(each, classes)] or [
            each for each in named if self._is_a(each, classes)
        ]
        return self._random.choice(fitting if fitting and self._maybe(0.9) else chosen)

    def _is_a(self, term: Term, classes: Collection[str]) -> bool:
        match term:
            case Variable(name):
                own = self._of[name]
            case Individual(each):
                own = iri(self.individuals[local_name(each)])
            case _:
                return False
        return any(self.vocabulary.is_a(own, cls) for cls in classes)

    def _literal(self, terms: list[Term], anything: bool) -> Condition:
        if self._maybe(0.8):
            relation = iri(self._random.choice(RELATIONS))
            signature = self._random.choice(self.vocabulary.relations[relation].signatures)
            subject = self._term(terms, (signature.domain,))
            others = [each for each in terms if each != subject] if self._maybe(0.8) else terms
            sides = [subject, self._term(others or terms, (signature.range,))]
            if anything and self._maybe(0.3):
                sides[self._random.randrange(2)] = Anything()
            return Holds(sides[0], relation, sides[1])
        name, value = self._random.choice([("open", True), ("open", False), ("mode", "a"), ("mode", "b")])
        owner = self._term(terms, self.vocabulary.properties[iri(name)].domains)
        return Compare(PropertyOf(owner, iri(name)), "==", Literal(value))  # type: ignore[arg-type]

    def _condition(self, terms: list[Term], depth: int) -> Condition:
        match self._random.randrange(6 if depth else 3):
            case 0 | 1:
                return self._literal(terms, anything=True)
            case 2:
                return Not(self._literal(terms, anything=True))
            case 3:
                return Or((self._condition(terms, depth - 1), self._condition(terms, depth - 1)))
            case 4:
                return And((self._condition(terms, depth - 1), self._condition(terms, depth - 1)))
            case _:
                variable, cls = f"x{depth}", iri(self._any_class())
                self._of[variable] = cls
                inner = self._condition([*terms, Variable(variable), Variable(variable)], depth - 1)
                return self._random.choice([Exists, Forall])(variable, cls, inner)

    def _scene(self) -> WorldState:
        people = [AddIndividual(iri(name), (iri(cls),)) for name, cls in self.individuals.items()]
        if self._maybe(0.3):
            people.append(AddIndividual(iri("x1"), (iri(self._any_class()),)))
        model = WorldModel(WorldState.empty(self.vocabulary).with_changes(people))
        for _ in range(self._random.randint(1, 8)):
            subject, object_ = (iri(self._random.choice(list(self.individuals))) for _ in range(2))
            try:
                model.commit((AddRelation(subject, iri(self._random.choice(RELATIONS)), object_),))
            except WorldError:
                continue
        return model.snapshot()

    def _goal(self, skills: SkillLibrary, start: WorldState) -> Condition:
        """Draw any condition or, more often, what is true after some random steps."""
        if self._maybe(0.3):
            return And((self._literal(self._everybody(), anything=True), self._condition(self._everybody(), 1)))
        state = start
        for _ in range(5):
            working = [after for step in steps(skills, state) if (after := worked(step, skills, state))]
            state = self._random.choice(working) if working else state
        new = sorted(set(relations_of(state)) - set(relations_of(start)))
        gone = sorted(set(relations_of(start)) - set(relations_of(state)))
        parts: list[Condition] = [Holds(Individual(s), r, Individual(o)) for r, s, o in self._some(new)]
        parts += [Not(Holds(Individual(s), r, Individual(o))) for r, s, o in self._some(gone)]
        return And(tuple(parts)) if parts else self._literal(self._everybody(), anything=True)

    def _everybody(self) -> list[Term]:
        return [Individual(iri(name)) for name in self.individuals]

    def _some(self, facts: list[Fact]) -> list[Fact]:
        return self._random.sample(facts, min(len(facts), 2))
