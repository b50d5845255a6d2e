"""Which data sheet a new thing of a scene has: the one that is named, or the shipped one for its class."""

from __future__ import annotations

from skillc.errors import RequestError
from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.world.state.terms import HAS_SHEET
from skillc_runtime.world.state.world_state import WorldState


def find_sheet(cls: str, named: str | None, state: WorldState) -> str | None:
    """Return the IRI of the data sheet of a new thing of a class; None if no sheet is named, and it needs none.

    RequestError if there is no such sheet, or if the class needs one and there is not exactly one for it.
    """
    if named is not None:
        return _look_up(named, state)
    if not _needs_sheet(cls, state.vocabulary):
        return None
    found = _sheets_for(cls, load_sheets(state.vocabulary))
    if len(found) == 1:
        return found[0]
    short = state.vocabulary.short
    listed = f": {', '.join(map(short, found))}" if found else ""
    raise RequestError(f"say --sheet NAME, as each {short(cls)} has a data sheet{listed}")


def _look_up(name: str, state: WorldState) -> str:
    short, known = state.vocabulary.short, load_sheets(state.vocabulary)
    matching = sorted(each for each in known.individuals | state.individuals if name in (short(each), local_name(each)))
    if len(matching) != 1:
        raise RequestError(f"there is {'more than one' if matching else 'no'} data sheet {name}")
    return matching[0]


def _needs_sheet(cls: str, vocabulary: Vocabulary) -> bool:
    return any(HAS_SHEET in term.required and vocabulary.is_a(cls, iri) for iri, term in vocabulary.classes.items())


def _sheets_for(cls: str, sheets: WorldState) -> list[str]:
    """Return the sheets that are called like the class, or else those whose class is called like it or a parent."""
    vocabulary = sheets.vocabulary
    names = {local_name(each) for each in vocabulary.classes if vocabulary.is_a(cls, each)}
    kinds = {each for each in vocabulary.classes if local_name(each) in {f"{name}Sheet" for name in names}}
    found = sorted({sheet for kind in kinds for sheet in sheets.instances(kind)})
    own = f"{local_name(cls)}-sheet".casefold()
    return [each for each in found if local_name(each).casefold() == own] or found
