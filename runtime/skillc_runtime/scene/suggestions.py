"""What a name in a scene may have been meant to be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches

from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Vocabulary, local_name

LISTED = 12
"""How many names help lists at most."""


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A line of help, and the fix that puts the only near name in the place of the wrong one."""

    help: str
    fix: Fix | None = None


def suggest(
    wrong: str, place: Span, vocabulary: Vocabulary, known: Iterable[str], fitting: Sequence[str] = ()
) -> Suggestion:
    """Return what is like a wrong IRI, first among the fitting ones; else the fitting ones that there are."""
    near = _near(wrong, fitting) or _near(wrong, known)
    if near:
        names = [vocabulary.short(iri) for iri in near]
        return Suggestion(f"did you mean {' or '.join(f'`{name}`' for name in names)}?", _fix(names, place))
    listed = [vocabulary.short(iri) for iri in sorted(fitting)]
    more = ", .." if listed[LISTED:] else ""
    return Suggestion(f"there is {', '.join(f'`{name}`' for name in listed[:LISTED])}{more}" if listed else "")


def _near(wrong: str, known: Iterable[str]) -> list[str]:
    """Return up to three IRIs whose local name is alike; those of the same local name alone if there are any."""
    by_name: dict[str, list[str]] = {}
    for iri in sorted(known):
        by_name.setdefault(local_name(iri), []).append(iri)
    name = local_name(wrong)
    same = [iri for iri in by_name.get(name, ()) if iri != wrong]
    if same:
        return same
    small = {other.lower(): other for other in by_name}
    near = get_close_matches(name.lower(), small, n=3, cutoff=0.6)
    return [iri for each in near for iri in by_name[small[each]]]


def _fix(names: list[str], place: Span) -> Fix | None:
    return Fix(place, names[0], f"write `{names[0]}`", safe=False) if len(names) == 1 else None
