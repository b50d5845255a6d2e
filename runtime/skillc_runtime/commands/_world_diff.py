"""What one scene says and another does not, as text and as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.store.triples import all_facts
from skillc_runtime.world.state.world_state import WorldState


def differences(one: WorldState, other: WorldState, as_json: bool) -> str:
    """Return the facts that are in the first only, with `-`, and in the second only, with `+`; by individual."""
    ours, theirs = frozenset(all_facts(one)), frozenset(all_facts(other))
    removed, added = _told(ours - theirs, one.vocabulary), _told(theirs - ours, other.vocabulary)
    if as_json:
        return json.dumps({"removed": removed, "added": added}, indent=2)
    if not removed and not added:
        return "no differences"
    lines = sorted([(fact["subject"], 0, fact) for fact in removed] + [(f["subject"], 1, f) for f in added], key=_order)
    return "\n".join(f"{'-+'[sign]} {fact['subject']} {fact['predicate']} {fact['value']}" for _, sign, fact in lines)


def _order(line: tuple[str, int, dict[str, str]]) -> tuple[str, str, int, str]:
    subject, sign, fact = line
    return subject, fact["predicate"], sign, fact["value"]


def _told(facts: Iterable[ox.Triple], vocabulary: Vocabulary) -> list[dict[str, str]]:
    """Return facts in words, sorted."""
    rows = (
        {
            "subject": _shown(fact.subject, vocabulary),
            "predicate": "a" if fact.predicate.value == RDF_TYPE else vocabulary.short(fact.predicate.value),
            "value": _shown(fact.object, vocabulary),
        }
        for fact in facts
    )
    return sorted(rows, key=lambda row: (row["subject"], row["predicate"], row["value"]))


def _shown(node: object, vocabulary: Vocabulary) -> str:
    match node:
        case ox.NamedNode(value=iri):
            return vocabulary.short(iri)
        case ox.Literal(value=text, datatype=datatype):
            return json.dumps(text, ensure_ascii=False) if datatype.value.endswith("#string") else text
        case _:
            return str(node)
