"""Templates: the facts that each individual created from one has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec
from msgspec.structs import replace

from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.names import NoSuchName, expand_name
from skillc_runtime.world.state.world_state import WorldState


class Templates(msgspec.Struct, frozen=True):
    """The templates by IRI, each with the changes that create an individual of its own IRI."""

    vocabulary: Vocabulary
    patterns: Mapping[str, tuple[Change, ...]]

    def instance(self, template: str, individual: str, state: WorldState) -> tuple[Change, ...]:
        """Return the changes that create an individual, by IRI, from a template, by IRI or `prefix:name`.

        Each template that it refers to also gets an individual, which is named after both. NoSuchName when there is no
        such template, ValueError when the individual exists already.
        """
        wanted = expand_name(template, self.vocabulary)
        if wanted not in self.patterns:
            known = ", ".join(map(self.vocabulary.short, sorted(self.patterns))) or "none"
            raise NoSuchName(f"there is no template {self.vocabulary.short(wanted)}; there is {known}")
        named = self._named(wanted, individual)
        taken = [each for each in named.values() if state.exists(each)]
        if taken:
            raise ValueError(f"there is a {self.vocabulary.short(taken[0])} already")
        made = [_rename_individuals(change, named) for each in named for change in self.patterns[each]]
        return tuple(sorted(made, key=lambda change: not isinstance(change, AddIndividual)))

    def _named(self, template: str, individual: str) -> dict[str, str]:
        """Return the IRIs of the individuals that a template creates, by template."""
        named, todo = {template: individual}, [template]
        while todo:
            for other in _objects(self.patterns[todo.pop()]):
                if other in self.patterns and other not in named:
                    named[other] = f"{individual}-{local_name(other)}"
                    todo.append(other)
        return named


def _objects(pattern: Iterable[Change]) -> Iterator[str]:
    return (change.object for change in pattern if isinstance(change, AddRelation))


def _rename_individuals(change: Change, named: Mapping[str, str]) -> Change:
    match change:
        case AddIndividual(individual, _) | SetProperty(individual, _, _):
            return replace(change, individual=named[individual])
        case AddRelation(subject, relation, object_):
            return AddRelation(named[subject], relation, named.get(object_, object_))
        case _:
            raise AssertionError(f"no scene says {change}")
