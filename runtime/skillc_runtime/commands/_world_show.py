"""Single individuals of a scene: those in which words occur, and all there is to know of some."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from skillc_runtime.commands import _listing
from skillc_runtime.world.state.elements import search
from skillc_runtime.world.state.listing import Entry, list_entries
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class _Known:
    """What is known of an individual beside what is written of it: classes, what leads to it, and what follows."""

    classes: tuple[str, ...]
    leading: tuple[tuple[str, str], ...]
    follows: tuple[tuple[str, str], ...]


def found(state: WorldState, labels: Mapping[str, str], words: str, among: frozenset[str]) -> frozenset[str]:
    """Return the individuals in whose names, labels, classes or texts all the words occur."""
    wanted = words.casefold().split()
    labelled = {iri for iri, label in labels.items() if all(word in label.casefold() for word in wanted)}
    return frozenset({each.iri for each in search(state, words)} | labelled) & among


def shown(state: WorldState, labels: Mapping[str, str], individuals: Iterable[str], as_json: bool) -> str:
    """Return all that is known of individuals: what is written, what leads to them, and what follows."""
    entries = list_entries(state, individuals)
    if as_json:
        return json.dumps([_object(entry, labels, state) for entry in entries], indent=2)
    return "\n\n".join(_text(entry, labels, state) for entry in entries)


def _known(entry: Entry, state: WorldState) -> _Known:
    one, written = entry.individual, set(entry.relations)
    types = state.types(one)
    implied = ((relation, other) for relation in state.facts for other in state.objects(one, relation))
    leading = ((other, relation) for relation, links in state.asserted.items() for other in links.backward.get(one))
    return _Known(
        tuple(sorted(state.axioms.superclasses(types) - types)),
        tuple(sorted(leading)),
        tuple(sorted(pair for pair in implied if pair not in written)),
    )


def _text(entry: Entry, labels: Mapping[str, str], state: WorldState) -> str:
    short, known = state.vocabulary.short, _known(entry, state)
    lines = [_listing.paragraph(entry, labels.get(entry.individual), state)]
    lines += [f"  also a   {', '.join(map(short, known.classes))}"] if known.classes else []
    lines += [f"  from     {short(other)} {short(relation)}" for other, relation in known.leading]
    lines += [f"  follows  {short(relation)} {short(other)}" for relation, other in known.follows]
    return "\n".join(lines)


def _object(entry: Entry, labels: Mapping[str, str], state: WorldState) -> dict[str, object]:
    short, known = state.vocabulary.short, _known(entry, state)
    return {
        **_listing.as_object(entry, labels.get(entry.individual), state),
        "also": [short(cls) for cls in known.classes],
        "from": [[short(other), short(relation)] for other, relation in known.leading],
        "follows": [[short(relation), short(other)] for relation, other in known.follows],
    }
