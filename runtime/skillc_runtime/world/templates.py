"""Templates of a scene: what is said of a `skiros:Template` is a fact about each individual that is made of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from skillc_compiler.library.vocabulary import Vocabulary, local_name
from skillc_compiler.turtle.statements import Statement
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.world.called import NoSuchName, called
from skillc_runtime.world.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.documents import Document, SceneError, parse, resolved
from skillc_runtime.world.individuals import (
    NAMED_INDIVIDUAL,
    facts,
    iri_of,
    is_remark,
    with_own_classes,
    with_own_prefixes,
)
from skillc_runtime.world.reading import Reader
from skillc_runtime.world.scene import sheets
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.terms import HAS_TEMPLATE, TEMPLATE


@dataclass(frozen=True, slots=True)
class Templates:
    """The templates by IRI, each with what makes an individual of its own IRI out of it."""

    vocabulary: Vocabulary
    patterns: Mapping[str, tuple[Change, ...]]

    def instance(self, template: str, individual: str, state: WorldState) -> tuple[Change, ...]:
        """Return the changes that make an individual, by IRI, of a template, by IRI or `prefix:name`.

        Of each template that it refers to an individual is made as well, called after both. NoSuchName when there is
        no such template, ValueError when there is such an individual already.
        """
        wanted = called(template, self.vocabulary)
        if wanted not in self.patterns:
            known = ", ".join(map(self.vocabulary.short, sorted(self.patterns))) or "none"
            raise NoSuchName(f"there is no template {self.vocabulary.short(wanted)}; there is {known}")
        named = self._named(wanted, individual)
        taken = [each for each in named.values() if state.exists(each)]
        if taken:
            raise ValueError(f"there is a {self.vocabulary.short(taken[0])} already")
        made = [_renamed(change, named) for each in named for change in self.patterns[each]]
        return tuple(sorted(made, key=lambda change: not isinstance(change, AddIndividual)))

    def _named(self, template: str, individual: str) -> dict[str, str]:
        """Return what individuals are called, by template, that one leads to."""
        named, todo = {template: individual}, [template]
        while todo:
            for other in _objects(self.patterns[todo.pop()]):
                if other in self.patterns and other not in named:
                    named[other] = f"{individual}-{local_name(other)}"
                    todo.append(other)
        return named


def load_templates(path: Path, vocabulary: Vocabulary) -> Templates:
    """Return the templates of a scene file, which may speak of the packaged data sheets; SceneError for mistakes."""
    return templates_of([Document.read(path), *sheets()], vocabulary)


def templates_of(documents: Iterable[Document], vocabulary: Vocabulary) -> Templates:
    """Return the templates of Turtle documents; SceneError with what is wrong with them or the documents."""
    parsed = [parse(document, vocabulary.namespaces) for document in documents]
    said = [resolved(each, vocabulary.aliases) for document in parsed for each in document.statements]
    vocabulary = with_own_classes(with_own_prefixes(vocabulary, parsed), said)
    templates = {
        iri_of(each.subject) for each in said if each.predicate == RDF_TYPE and iri_of(each.object) == TEMPLATE
    }
    reader = Reader(vocabulary, [*facts(said, vocabulary), *_patterns(said, templates)], ())
    patterns: dict[str, list[Change]] = {each: [] for each in sorted(templates)}
    for change, statement in reader.changes():
        patterns.get(iri_of(statement.subject), []).append(change)
    problems = [problem for document in parsed for problem in document.problems] + list(reader.problems)
    if problems:
        raise SceneError(problems)
    return Templates(vocabulary, {each: tuple(changes) for each, changes in patterns.items()})


def _patterns(said: Iterable[Statement], templates: set[str]) -> Iterator[Statement]:
    """Yield what is said of templates and is to be true of individuals."""
    passed = {TEMPLATE, NAMED_INDIVIDUAL}
    for each in said:
        told = iri_of(each.subject) in templates and iri_of(each.object) not in passed
        if told and each.predicate != HAS_TEMPLATE and not is_remark(each.predicate):
            yield each


def _objects(pattern: Iterable[Change]) -> Iterator[str]:
    return (change.object for change in pattern if isinstance(change, AddRelation))


def _renamed(change: Change, named: Mapping[str, str]) -> Change:
    match change:
        case AddIndividual(individual, _) | SetProperty(individual, _, _):
            return replace(change, individual=named[individual])
        case AddRelation(subject, relation, object_):
            return AddRelation(named[subject], relation, named.get(object_, object_))
        case _:
            raise AssertionError(f"no scene says {change}")
