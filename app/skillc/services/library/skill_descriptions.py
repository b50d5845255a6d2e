"""The skills of a library in the world model: their descriptions, and which robots can do them by their hardware.

Queries see them in a named graph, whose IRI is that of the library. It is made when a query is answered, so that
nothing else that reads or keeps the world has to do with it, and it goes when the library goes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache

import msgspec
import pyoxigraph as ox

from skillc_compiler.emit import owl
from skillc_model.skills import SkillLibrary
from skillc_rdf.turtle.terms import OWL, RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.execution.selection.robot_skills import RobotImplementation, match_robots
from skillc_runtime.world.state.terms import SKILLC, SKIROS
from skillc_runtime.world.state.world_state import WorldState

HAS_SKILL, CAN_RUN = SKIROS + "hasSkill", SKILLC + "canRun"
REJECTION, REJECTED_FOR, REJECTS, REASON = (SKILLC + name for name in ("Rejection", "rejectedFor", "rejects", "reason"))
KINDS = {
    HAS_SKILL: "ObjectProperty",
    CAN_RUN: "AnnotationProperty",
    REJECTION: "Class",
    REJECTED_FOR: "AnnotationProperty",
    REJECTS: "AnnotationProperty",
    REASON: "AnnotationProperty",
}
"""The terms that say what robots can do."""
_ASKS_FOR_ROBOTS = re.compile("|".join((*(rf"\b{local_name(each)}\b" for each in KINDS), r"\b(?i:graph|from)\b")))
_MOST_LIBRARIES = 4


def describe_skills(library: SkillLibrary, state: WorldState, sparql: str) -> list[ox.Quad]:
    """Return what a query is to know of a library's skills: in their named graph, and in the default graph.

    What the robots of the world can do is computed only for a query that names a term of `KINDS`, or graphs.
    """
    statements = list(_describe(_Described(library)))
    if _ASKS_FOR_ROBOTS.search(sparql):
        statements += _in_both_graphs(_describe_robots(library, state), library)
    return statements


def with_library_prefix(vocabulary: Vocabulary, library: SkillLibrary) -> Vocabulary:
    """Return a vocabulary in which the IRIs of a library's skills have a prefix: the empty one, or another free one."""
    known = vocabulary.prefixes
    if library.namespace in known.values():
        return vocabulary
    free = next(each for each in ("", library.name, f"{library.name}_skills") if each not in known)
    return msgspec.structs.replace(vocabulary, prefixes={**known, free: library.namespace})


class _Described:
    """A library as the key of its description, which depends on nothing but its sources and its vocabulary."""

    def __init__(self, library: SkillLibrary) -> None:
        self.library = library

    def __hash__(self) -> int:
        return hash(self.library.hash)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Described):
            return NotImplemented
        mine, theirs = self.library, other.library
        return (mine.hash, mine.namespace, mine.vocabulary) == (theirs.hash, theirs.namespace, theirs.vocabulary)


@lru_cache(_MOST_LIBRARIES)
def _describe(key: _Described) -> tuple[ox.Quad, ...]:
    """Return the statements of skills.ttl."""
    text = owl.emit(key.library)["skills.ttl"]
    parsed = ox.parse(text.encode(), format=ox.RdfFormat.TURTLE)
    return tuple(_in_both_graphs((each.triple for each in parsed), key.library))


def _in_both_graphs(statements: Iterable[ox.Triple], library: SkillLibrary) -> Iterator[ox.Quad]:
    """Yield statements in the graph of a library and in the default one: the union of graphs has some of them twice."""
    graph = ox.NamedNode(library.namespace.removesuffix("#"))
    for each in statements:
        yield ox.Quad(each.subject, each.predicate, each.object, graph)
        yield ox.Quad(each.subject, each.predicate, each.object)


def _describe_robots(library: SkillLibrary, state: WorldState) -> Iterator[ox.Triple]:
    """Yield which robot has which skill and can run which implementation, and why it cannot run the others."""
    for term, kind in KINDS.items():
        yield _triple(ox.NamedNode(term), RDF_TYPE, ox.NamedNode(OWL + kind))
    skilled = set[tuple[str, str]]()
    for each in match_robots(library, state):
        robot, skill = ox.NamedNode(each.robot), each.implementation.skill
        implementation = ox.NamedNode(f"{library.namespace}{skill}.{each.implementation.name}")
        if each.why_not:
            yield from _describe_rejection(each, implementation)
            continue
        yield _triple(robot, CAN_RUN, implementation)
        if (each.robot, skill) not in skilled:
            skilled.add((each.robot, skill))
            yield _triple(robot, HAS_SKILL, ox.NamedNode(library.namespace + skill))


def _describe_rejection(each: RobotImplementation, implementation: ox.NamedNode) -> Iterator[ox.Triple]:
    rejection = ox.BlankNode()
    yield _triple(rejection, RDF_TYPE, ox.NamedNode(REJECTION))
    yield _triple(rejection, REJECTED_FOR, ox.NamedNode(each.robot))
    yield _triple(rejection, REJECTS, implementation)
    yield _triple(rejection, REASON, ox.Literal(each.why_not))


def _triple(subject: ox.NamedNode | ox.BlankNode, predicate: str, value: ox.NamedNode | ox.Literal) -> ox.Triple:
    return ox.Triple(subject, ox.NamedNode(predicate), value)
