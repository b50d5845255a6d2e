"""Why a skill's implementations are tried in the order they are tried."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from skillc_model.skills import Implementation
from skillc_model.words import type_text
from skillc_rdf.vocabulary.types import ClassType, Vocabulary


def reasons(ranked: Sequence[Implementation], vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return for each implementation, in rank order, why it stands before the next; Markdown."""
    if len(ranked) == 1:
        return ("The only one in this library.",)
    return (*(_before(one, other, vocabulary) for one, other in pairwise(ranked)), "Tried last.") if ranked else ()


def _before(one: Implementation, other: Implementation, vocabulary: Vocabulary) -> str:
    apart = [p for p, q in _classes(one, other) if vocabulary.disjoint(p[1], q[1])]
    if apart:
        return f"Never competes with `{other.name}`: no `{apart[0][0]}` fits both."
    narrower = [p[0] for p, q in _classes(one, other) if p[1] != q[1] and vocabulary.is_a(p[1], q[1])]
    wider = [p for p, q in _classes(one, other) if not vocabulary.is_a(p[1], q[1])]
    if narrower and not wider:
        types = {parameter.name: type_text(parameter.type, vocabulary) for parameter in one.parameters}
        listed = ", ".join(f"`{name}: {types[name]}`" for name in narrower)
        return f"Tried before `{other.name}`, because it is made for fewer cases: {listed}."
    if one.prefer != other.prefer:
        return f"Tried before `{other.name}`, because of `prefer {one.prefer:g}` against `{other.prefer:g}`."
    return f"Tried before `{other.name}`, because it is declared first and neither is made for fewer cases."


def _classes(one: Implementation, other: Implementation) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """Return the parameters that are individuals, with their names and classes in both implementations."""
    return [
        ((p.name, p.type.iri), (q.name, q.type.iri))
        for p, q in zip(one.parameters, other.parameters, strict=True)
        if isinstance(p.type, ClassType) and isinstance(q.type, ClassType)
    ]
