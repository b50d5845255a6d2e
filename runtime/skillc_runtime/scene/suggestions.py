"""Suggestions for misspelt names in a scene."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import msgspec

from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span
from skillc_dsl.spelling import close_names
from skillc_rdf.vocabulary.types import Vocabulary, local_name

LISTED = 12
"""The maximum number of names in a hint."""


class Suggestion(msgspec.Struct, frozen=True):
    """A hint, and the fix that replaces the wrong name if only one name is similar."""

    help: str
    fix: Fix | None = None


def suggest(
    wrong: str, place: Span, vocabulary: Vocabulary, known: Iterable[str], fitting: Sequence[str] = ()
) -> Suggestion:
    """Return names similar to a wrong IRI, preferably fitting ones; if there are none, list the fitting ones."""
    near = _near(wrong, fitting) or _near(wrong, known)
    if near:
        names = [vocabulary.short(iri) for iri in near]
        return Suggestion(f"did you mean {' or '.join(f'`{name}`' for name in names)}?", _fix(names, place))
    listed = [vocabulary.short(iri) for iri in sorted(fitting)]
    more = ", .." if listed[LISTED:] else ""
    return Suggestion(f"there is {', '.join(f'`{name}`' for name in listed[:LISTED])}{more}" if listed else "")


def _near(wrong: str, known: Iterable[str]) -> list[str]:
    """Return IRIs with the same local name or, if there are none, with local names that are probably meant."""
    by_name: dict[str, list[str]] = {}
    for iri in sorted(known):
        by_name.setdefault(local_name(iri), []).append(iri)
    name = local_name(wrong)
    same = [iri for iri in by_name.get(name, ()) if iri != wrong]
    if same:
        return same
    return [iri for each in close_names(name, by_name) for iri in by_name[each]]


def _fix(names: list[str], place: Span) -> Fix | None:
    return Fix(place, names[0], f"write `{names[0]}`", safe=False) if len(names) == 1 else None
