"""Resolves names that people write: IRIs, or `prefix:name` with the prefixes of the vocabulary and the scene."""

from __future__ import annotations

from difflib import get_close_matches

from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.world.state.terms import SHEET
from skillc_runtime.world.state.world_state import WorldState

LISTED = 8
"""The maximum number of names in a message."""


class NoSuchName(LookupError):
    """A name that the world and its vocabulary do not have; the message suggests similar ones."""


def expand_name(name: str, vocabulary: Vocabulary) -> str:
    """Return the IRI of a name, with aliases of terms replaced; NoSuchName for an unknown prefix."""
    prefix, colon, local = name.partition(":")
    if not colon:
        raise NoSuchName(f"`{name}` is neither an IRI nor PREFIX:NAME")
    if prefix in vocabulary.prefixes:
        name = vocabulary.prefixes[prefix] + local
    elif "/" not in local and prefix != "urn":
        raise NoSuchName(f"there is no prefix `{prefix}`; there is {_list_names(sorted(vocabulary.prefixes))}")
    return vocabulary.aliases.get(name, name)


def resolve_individual(name: str, state: WorldState) -> str:
    """Return the IRI of an existing individual; NoSuchName suggests similar names."""
    iri = expand_name(name, state.vocabulary)
    if state.exists(iri):
        return iri
    short = state.vocabulary.short
    things = (each for each in sorted(state.individuals) if not state.is_a(each, SHEET))
    by_name = {local_name(each): short(each) for each in things}
    near = [by_name[each] for each in get_close_matches(local_name(iri), by_name, n=3)]
    cure = f"did you mean {' or '.join(near)}?" if near else f"there is {_list_names(sorted(by_name.values()))}"
    raise NoSuchName(f"there is no individual {short(iri)}; {cure}")


def resolve_term(name: str, vocabulary: Vocabulary) -> str:
    """Return the IRI of an existing class, relation or property; NoSuchName suggests similar names."""
    iri = expand_name(name, vocabulary)
    known = vocabulary.ancestors.keys() | vocabulary.relations.keys() | vocabulary.properties.keys()
    if iri in known:
        return iri
    by_name = {local_name(each): vocabulary.short(each) for each in sorted(known)}
    near = [by_name[each] for each in get_close_matches(local_name(iri), by_name, n=3)]
    cure = f"; did you mean {' or '.join(near)}?" if near else ""
    raise NoSuchName(f"there is no term {vocabulary.short(iri)}{cure}")


def _list_names(names: list[str]) -> str:
    return (", ".join(names[:LISTED]) + ", .." * (len(names) > LISTED)) or "none"
