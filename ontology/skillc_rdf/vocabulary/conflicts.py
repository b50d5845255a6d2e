"""Decides which conflicts of ontologies count: those of terms that a library uses."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.expressions import RequiredValue, find_needs
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.types import Vocabulary

LISTED = 4
"""The most terms that are named for a file whose conflicts do not count."""


@dataclass(frozen=True, slots=True)
class Conflict(Diagnostic):
    """An error of an ontology: nothing can be of the class `term`, or have the relation or property `term`.

    `concerns` are the terms for which this is so too: the term itself, and those that imply or require it.
    """

    term: str = ""
    concerns: frozenset[str] = frozenset()


def with_concerned(problems: Sequence[Diagnostic], graph: Graph, vocabulary: Vocabulary) -> tuple[Diagnostic, ...]:
    """Return the problems; each conflict has all terms that it concerns."""
    if not any(isinstance(each, Conflict) for each in problems):
        return tuple(problems)
    resting = _resting_on(find_needs(graph, vocabulary), vocabulary)
    sources = vocabulary.closure.sources

    def concerned(iri: str) -> Iterator[str]:
        yield from resting.get(iri, ())
        yield from (each.relation for each in sources.get(iri, ()))

    return tuple(
        replace(each, concerns=frozenset(reachable((each.term,), concerned))) if isinstance(each, Conflict) else each
        for each in problems
    )


def _resting_on(needs: Mapping[str, Sequence[RequiredValue]], vocabulary: Vocabulary) -> dict[str, set[str]]:
    """Return for each term the classes directly below it, and those that require it."""
    found: dict[str, set[str]] = defaultdict(set)
    for iri, term in vocabulary.classes.items():
        for parent in term.parents:
            found[parent].add(iri)
    for iri, needed in needs.items():
        for need in needed:
            found[need.property].add(iri)
            found[need.filler or ""].add(iri)
    return found


def judge_conflicts(
    problems: Iterable[Diagnostic], vocabulary: Vocabulary, named: Mapping[str, Span]
) -> Iterator[Diagnostic]:
    """Yield the problems; conflicts that concern no term that a library names are one warning for each file.

    `named` are the terms that the library names, with a place of each.
    """
    idle: list[Conflict] = []
    for each in problems:
        if not isinstance(each, Conflict):
            yield each
        elif uses := sorted((named[iri], iri) for iri in each.concerns & named.keys()):
            place, iri = uses[0]
            told = f"`{vocabulary.short(iri)}` is used here"
            labels = (*each.labels, Label(place, told))
            yield Diagnostic(each.name, each.span, each.message, each.help, each.severity, labels)
        else:
            idle.append(each)
    for _, found in groupby(sorted(idle, key=lambda one: one.span), key=lambda one: one.span.path):
        yield _unused(tuple(found), vocabulary)


def _unused(conflicts: Sequence[Conflict], vocabulary: Vocabulary) -> Diagnostic:
    """Return the warning for the conflicts of a file that do not count."""
    names = list(dict.fromkeys(f"`{vocabulary.short(each.term)}`" for each in conflicts))
    listed = ", ".join(names[:LISTED]) + (f" and {len(names) - LISTED} more" if names[LISTED:] else "")
    said = "has a conflict" if len(names) == 1 else f"has {len(names)} conflicts"
    first = conflicts[0]
    return Diagnostic(
        "unused-conflict",
        first.span,
        f"this file {said} in terms that the library does not use: {listed}",
        help="correct it before a skill names one of them: it is an error then",
        severity="warning",
        labels=tuple(Label(each.span, each.message) for each in conflicts[:LISTED]),
    )
