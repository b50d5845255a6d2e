"""Reads edits of a running world as changes: facts as `skillc scene edit` takes them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import pyoxigraph as ox

from skillc.errors import RequestError
from skillc.services.scene.editing import StatementEdit, parse_edit
from skillc.services.scene.fact_text import FORMS
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.store.literals import LiteralError, read_literal
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.names import NoSuchName, resolve_individual, resolve_term
from skillc_runtime.world.state.world_state import WorldState


def read_edits(edits: Sequence[str], state: WorldState) -> tuple[Change, ...]:
    """Return the changes that edits make together; RequestError if one is not valid, or names what does not exist.

    Numbers are in SI units. A class that an edit states creates the individual, which later edits can name.
    """
    changes, after = list[Change](), state
    for text in edits:
        try:
            made = tuple(_read(text, parse_edit(text, dict(state.vocabulary.prefixes), state.vocabulary), after))
        except (NoSuchName, LiteralError) as error:
            raise RequestError(f"`{text}`: {error}") from error
        changes += made
        after = after.with_changes(made)
    return tuple(changes)


def _read(text: str, edit: StatementEdit, state: WorldState) -> Iterator[Change]:
    if edit.predicate is None or edit.object is None:
        yield RemoveIndividual(resolve_individual(edit.subject, state))
    elif edit.predicate == RDF_TYPE:
        cls = resolve_term(iri_of(edit.object), state.vocabulary)
        if not edit.added:
            raise RequestError(f"`{text}`: the class of an individual stays; remove it with `not {_name(edit, state)}`")
        yield AddIndividual(edit.subject, (cls,))
    elif edit.predicate in state.vocabulary.relations:
        subject, object_ = (resolve_individual(each, state) for each in (edit.subject, iri_of(edit.object)))
        yield (AddRelation if edit.added else RemoveRelation)(subject, edit.predicate, object_)
    else:
        yield _read_property(text, edit, edit.predicate, edit.object, state)


def _read_property(text: str, edit: StatementEdit, name: str, value: object, state: WorldState) -> Change:
    individual = resolve_individual(edit.subject, state)
    term = state.vocabulary.properties[resolve_term(name, state.vocabulary)]
    if not edit.added:
        return ClearProperty(individual, name)
    if not isinstance(value, ox.Literal):
        raise RequestError(f"`{text}`: {state.vocabulary.short(name)} takes a value; write {FORMS}")
    return SetProperty(individual, name, read_literal(value, term))


def _name(edit: StatementEdit, state: WorldState) -> str:
    return state.vocabulary.short(edit.subject)
