"""Which data sheet a new thing of a scene has: the one that is named, or the shipped one for its class."""

from __future__ import annotations

from skillc.errors import RequestError
from skillc_dsl.spelling import did_you_mean
from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.scene.checks.data_sheets import list_sheet_kinds
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.world.state.terms import HAS_SHEET, SHEET
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
    short, known = state.vocabulary.short, load_sheets(state.vocabulary).instances(SHEET) | state.instances(SHEET)
    matching = sorted(each for each in known if name in (short(each), local_name(each)))
    if len(matching) == 1:
        return matching[0]
    if matching:
        raise RequestError(f"there is more than one data sheet {name}: {', '.join(map(short, matching))}")
    meant = did_you_mean(name, map(local_name, known))
    raise RequestError(f"there is no data sheet {name}{f'; {meant}' if meant else ''}")


def _needs_sheet(cls: str, vocabulary: Vocabulary) -> bool:
    return any(HAS_SHEET in term.required and vocabulary.is_a(cls, iri) for iri, term in vocabulary.classes.items())


def _sheets_for(cls: str, sheets: WorldState) -> list[str]:
    """Return the sheet that is called like the class, or else all of the kinds that describe such a device."""
    kinds = list_sheet_kinds(cls, sheets.vocabulary)
    found = sorted({sheet for kind in kinds for sheet in sheets.instances(kind)})
    own = f"{local_name(cls)}-sheet".casefold()
    return [each for each in found if local_name(each).casefold() == own] or found
