"""A reasoner orders implementations as the compiler ranks them, in the shipped library and in generated ones."""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from itertools import permutations
from pathlib import Path
from typing import Any

import pytest

from emit.reasoner import classified, needs_java
from emit.test_shipped import wiping
from skillc_compiler.emit import owl
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.skills import Implementation, SkillLibrary
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import ClassType

CLASSES = 14
SKILLS = 12
KINDS = ("in", "in", "infer", "opt")

pytestmark = [needs_java, pytest.mark.reasoner]


class Dice:
    """Draws classes with one or two parents, and skills with implementations that refine several parameters."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._parents = {0: []}
        for number in range(1, CLASSES):
            self._parents[number] = self._random.sample(range(number), min(number, self._random.choice((1, 1, 2))))

    def vocabulary(self) -> Iterator[str]:
        """Yield the lines of a vocabulary in Turtle."""
        yield "@prefix g: <http://example.org/generated#> . @prefix owl: <http://www.w3.org/2002/07/owl#> ."
        yield "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix vann: <http://purl.org/vocab/vann/> ."
        yield '<http://example.org/generated> a owl:Ontology ; vann:preferredNamespacePrefix "g" ;'
        yield '    vann:preferredNamespaceUri "http://example.org/generated#" .'
        yield "g:near a owl:ObjectProperty ; rdfs:domain g:C0 ; rdfs:range g:C0 ."
        for number, parents in self._parents.items():
            above = "".join(f" ; rdfs:subClassOf g:C{each}" for each in parents)
            yield f"g:C{number} a owl:Class{above} ."

    def skills(self) -> Iterator[str]:
        """Yield the lines of a library."""
        yield "use g"
        for number in range(SKILLS):
            names = [f"p{each}" for each in range(self._random.randint(1, 3))]
            classes = {name: self._random.randrange(4) for name in names}
            yield f"skill S{number} {{"
            for name in names:
                kind = "in" if name == "p0" else self._random.choice(KINDS)
                yield f"    {kind} {name}: C{classes[name]}"
                if kind == "infer":
                    yield f"    pre p0 near {name}"
            yield "    noplan\n}"
            for way in range(self._random.randint(2, 5)):
                yield f'impl w{way} of S{number} {{\n    run python "a.b:C"'
                yield from (f"    refine {name}: C{self._below(classes[name])}" for name in names)
                yield f"    prefer {self._random.randrange(3)}\n}}"

    def _below(self, above: int) -> int:
        fitting = [each for each in range(above, CLASSES) if above in self._ancestors(each)]
        return self._random.choice(fitting)

    def _ancestors(self, number: int) -> set[int]:
        return {number, *(up for each in self._parents[number] for up in self._ancestors(each))}


def generated(seed: int) -> SkillLibrary:
    """Compile a generated library."""
    dice = Dice(seed)
    vocabulary = load([Source("g.ttl", "\n".join(dice.vocabulary()))])
    outcome = compile([Source("g.skill", "\n".join(dice.skills()))], vocabulary.value, {}, f"generated{seed}")
    unsound = [each for each in outcome.diagnostics if each.severity == "error" and each.name != "python-target"]
    assert not unsound, unsound
    assert len(outcome.value.skills) == SKILLS
    return outcome.value


@cache
def libraries() -> tuple[SkillLibrary, ...]:
    return (wiping(), generated(1))


@cache
def world(number: int) -> Any:
    """Return what follows from a library; from the shipped one with all vocabularies, devices and a scene."""
    printed = owl.emit(libraries()[number])["skills.ttl"]
    return classified([printed] if number else [printed, *shipped()])


def shipped() -> Iterator[str]:
    """Yield the texts that the library is used with."""
    yield from (text for _, text in vocabulary_files())
    root = Path(str(files("skillc_ontology")))
    for folder in ("robots", "grippers", "tools"):
        yield from (path.read_text() for path in sorted((root / folder).glob("*.ttl")))
    yield (root / "scenes" / "ur5e_whiteboard.ttl").read_text()


def narrower(library: SkillLibrary, one: Implementation, other: Implementation) -> bool:
    """Whether every argument of a class that fits `one` fits `other`."""
    pairs = [(p.type, q.type) for p, q in zip(one.parameters, other.parameters, strict=True)]
    classes = [(p, q) for p, q in pairs if isinstance(p, ClassType) and isinstance(q, ClassType)]
    return all(library.vocabulary.is_a(p.iri, q.iri) for p, q in classes)


def alike(one: Implementation, other: Implementation) -> bool:
    """Whether two take the same arguments; owlready2 forgets what the reasoner found of classes that are the same."""
    return [each.type for each in one.parameters] == [each.type for each in other.parameters]


@pytest.mark.parametrize("number", range(2))
def test_everything_is_consistent_and_every_class_can_have_members(number: int) -> None:
    assert list(world(number).inconsistent_classes()) == []


@pytest.mark.parametrize("number", range(2))
def test_subsumption_is_specificity(number: int) -> None:
    library, seen = libraries()[number], 0
    for skill in library.skills.values():
        ways = library.implementations_of(skill.name)
        found = {each.name: world(number)[f"{library.namespace}{skill.name}.{each.name}"] for each in ways}
        for one, other in permutations(ways, 2):
            if alike(one, other) or all(sum(alike(each, way) for each in ways) > 1 for way in (one, other)):
                continue
            if any(each.iri.endswith("#Thing") for each in found[one.name].is_a):
                continue  # owlready2 forgets it of a class that is an individual, too, since it has own preconditions
            below = found[other.name] in found[one.name].ancestors()
            assert below == narrower(library, one, other), (skill.name, one.name, other.name)
            seen += 1
    assert seen


@pytest.mark.parametrize("number", range(2))
def test_nothing_less_specific_is_tried_first(number: int) -> None:
    library, seen = libraries()[number], 0
    for skill in library.skills.values():
        ways = library.implementations_of(skill.name)
        found = [world(number)[f"{library.namespace}{skill.name}.{each.name}"] for each in ways]
        for rank, earlier in enumerate(found):
            for later in found[rank + 1 :]:
                equal = earlier in later.ancestors() and later in earlier.ancestors()
                assert equal or earlier not in later.ancestors(), (skill.name, earlier, later)
                seen += 1
    assert seen
