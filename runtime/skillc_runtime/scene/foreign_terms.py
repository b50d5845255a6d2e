"""Unknown terms that are one problem: those of a namespace that nothing declares, and one that is used many times."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Vocabulary, local_name, namespace_of

MOST = 3
"""The maximum number of further places that are shown."""


class TermUse(NamedTuple):
    """The IRI of a class or predicate, and where it is used."""

    iri: str
    place: Span


class RepeatedTerm(NamedTuple):
    """An IRI, and all its uses but the first."""

    iri: str
    others: Sequence[TermUse]


def group_repeated_terms(unknown: Iterable[TermUse]) -> Iterator[RepeatedTerm]:
    """Yield the unknown terms that are used more often than would be shown one by one."""
    uses: dict[str, list[TermUse]] = defaultdict(list)
    for use in unknown:
        uses[use.iri].append(use)
    yield from (RepeatedTerm(iri, found[1:]) for iri, found in uses.items() if len(found) > MOST)


def say_where_else(problem: Diagnostic, others: Sequence[TermUse]) -> Diagnostic:
    """Return the problem of a term at its first use, with the places of others; no edit mends all of them."""
    labels = tuple(Label(other.place, "also here") for other in others[:MOST])
    message = f"{problem.message}, which is used {len(others) + 1} times"
    return replace(problem, message=message, labels=labels, fix=None)


def group_foreign_terms(unknown: Iterable[TermUse], vocabulary: Vocabulary) -> Mapping[str, Sequence[TermUse]]:
    """Return the uses of unknown terms by namespace, if they are several terms of one that no vocabulary knows."""
    known = {namespace_of(iri) for iri in vocabulary.terms}
    found: dict[str, list[TermUse]] = defaultdict(list)
    for use in unknown:
        if namespace_of(use.iri) not in known:
            found[namespace_of(use.iri)].append(use)
    return {namespace: uses for namespace, uses in found.items() if len({use.iri for use in uses}) > 1}


def report_foreign_terms(namespace: str, uses: Sequence[TermUse], vocabulary: Vocabulary) -> Diagnostic:
    """Return the problem of the terms of a namespace, at the first of them; another one may have all of them."""
    names = {local_name(use.iri) for use in uses}
    there: dict[str, set[str]] = defaultdict(set)
    for iri in vocabulary.terms:
        there[namespace_of(iri)].add(local_name(iri))
    meant = [each for each, found in there.items() if names <= found]
    help_ = f"did you mean <{meant[0]}>?" if len(meant) == 1 else "declare them in a .skill file or in an ontology"
    first, *others = uses
    labels = tuple(Label(other.place, "also here") for other in others[:MOST])
    return Diagnostic("unknown-prefix", first.place, f"nothing declares terms of <{namespace}>", help_, labels=labels)
