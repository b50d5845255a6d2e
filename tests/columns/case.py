"""A drawn library with the worlds, bodies and goals that it is tried with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from random import Random

from columns.bodies import BodyWriter
from columns.meaning import Condition as Drawn
from columns.nodes import Node
from columns.searching import walk
from columns.skills import Skill
from columns.worlds import CLASSES, TERMS, World, draw_people, draw_world
from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary

DRAWS, WORLDS = 40, 5


@dataclass
class Case:
    """A drawn library with bodies and goals about the things of some worlds, one of which is looked at."""

    skills: list[Skill]
    bodies: list[Node]
    goals: list[Drawn]
    worlds: list[World]
    text: str
    library: SkillLibrary

    @property
    def world(self) -> World:
        """The world that is looked at."""
        return self.worlds[0]

    @property
    def told(self) -> str:
        """What a failing test shows."""
        return f"{self.text.removeprefix(TERMS)}\n{sorted(self.world.facts, key=str)} {self.world.people}"

    def each_world(self) -> Iterator[Case]:
        """Yield the case with each world as that which is looked at."""
        yield from (replace(self, worlds=[each]) for each in self.worlds)


def draw_case(seed: int, number: int = WORLDS) -> Case:
    """Draw a library that compiles without errors, with a number of worlds."""
    random = Random(seed)
    for _ in range(DRAWS):
        writer, people = BodyWriter(random), draw_people(random)
        worlds = [draw_world(random, people) for _ in range(number)]
        world, skills = worlds[0], writer.library()
        goals = [writer.goal(world, walk(skills, world, random)) for _ in range(2)]
        writer.sums = True
        bodies = [writer.node({each: CLASSES[each] for each in people}, 3) for _ in range(2)]
        text = TERMS + "\n".join([*(each.text for each in skills), *(each.skill for each in writer.tallies)])
        within = random.randint(0, 12) + 0.5
        tasks = [("go0", f"do {bodies[0].text}"), ("go1", f"within {within} s\n    do {bodies[1].text}")]
        tasks += [(f"goal{at}", f"goal {each.text}") for at, each in enumerate(goals)]
        text += "".join(f'\ntask {name} {{\n    scene "none.ttl"\n    {line}\n}}\n' for name, line in tasks)
        outcome = compile_sources([Source("columns.skill", text)], vocabulary(), {}, "columns", {})
        errors = [each for each in outcome.diagnostics if each.severity == "error"]
        if not errors:
            return Case(skills, bodies, goals, worlds, text, outcome.value)
    raise AssertionError(f"none of {DRAWS} libraries compiles")


@cache
def vocabulary() -> Vocabulary:
    """Return the vocabulary that libraries use."""
    return load_vocabulary()
