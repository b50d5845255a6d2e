"""Checks the classes that a scene declares."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import THING, Vocabulary
from skillc_runtime.scene.standard_terms import is_misspelt, standard_terms
from skillc_runtime.scene.statements import SUBCLASS, iri_of
from skillc_runtime.scene.suggestions import suggest


def have_valid_parents(classes: Iterable[str], vocabulary: Vocabulary) -> bool:
    """Whether all superclasses of the classes exist, and no class is its own superclass."""
    parents = [(iri, parent) for iri in classes for parent in vocabulary.classes[iri].parents]
    return all(parent in vocabulary.ancestors and not vocabulary.is_a(parent, iri) for iri, parent in parents)


def check_class_parents(said: Iterable[Statement], own: frozenset[str], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a problem for each declared class with an unknown superclass, and for each cycle of classes.

    A cycle is reported at its last statement, with labels at the others.
    """
    below = [each for each in said if each.predicate == SUBCLASS and iri_of(each.subject) in own]
    circles: dict[frozenset[str], list[Statement]] = {}
    for each in below:
        cls, parent = iri_of(each.subject), iri_of(each.object)
        if parent and parent not in vocabulary.ancestors:
            yield _unknown(each, parent, vocabulary)
        elif parent and vocabulary.is_a(parent, cls):
            circles.setdefault(_circle(cls, vocabulary), []).append(each)
    for statements in circles.values():
        yield _cycle(statements, vocabulary)


def individuals_of_unknown_classes(
    said: Iterable[Statement], own: frozenset[str], vocabulary: Vocabulary
) -> frozenset[str]:
    """Return the individuals of declared classes with unknown superclasses; they cannot be checked."""
    known = vocabulary.ancestors.keys()
    unknown = {cls for cls in own if not vocabulary.ancestors[cls] <= known}
    return frozenset(
        iri_of(each.subject) for each in said if each.predicate == RDF_TYPE and iri_of(each.object) in unknown
    )


def _unknown(each: Statement, parent: str, vocabulary: Vocabulary) -> Diagnostic:
    known = standard_terms(parent) if is_misspelt(parent) else vocabulary.classes
    near = suggest(parent, each.object_place, vocabulary, known)
    message = f"there is no class {vocabulary.short(parent)}"
    return Diagnostic("unknown-class", each.object_place, message, near.help or "declare it too", fix=near.fix)


def _circle(cls: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the classes that are both superclass and subclass of a class."""
    return frozenset(other for other in vocabulary.ancestors[cls] - {THING} if vocabulary.is_a(other, cls))


def _cycle(statements: list[Statement], vocabulary: Vocabulary) -> Diagnostic:
    *others, last = statements
    names = [vocabulary.short(iri_of(each.subject)) for each in others if each.subject != last.subject]
    way = "".join(f", by {name}" for name in dict.fromkeys(names))
    message = f"{vocabulary.short(iri_of(last.subject))} is declared below itself{way}"
    notes = tuple(Label(each.object_place, "part of the same cycle") for each in others)
    return Diagnostic("class-cycle", last.object_place, message, "remove one of the parents", labels=notes)
