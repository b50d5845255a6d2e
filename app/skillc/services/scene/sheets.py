"""Which data sheet a new thing of a scene has: the one that is named, or the shipped one for its class."""

from __future__ import annotations

from collections.abc import Callable

from skillc.errors import RequestError
from skillc_dsl.spelling import did_you_mean
from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.scene.checks.data_sheets import list_sheet_kinds
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.world.state.terms import HAS_SHEET, SHEET
from skillc_runtime.world.state.world_state import WorldState


def find_sheet(cls: str, named: str | None, state: WorldState) -> str | None:
    """Return the IRI of the data sheet of a new thing of a class; None if no sheet is named, and it needs none.

    RequestError if there is no such sheet, or if the class needs one, none is named, and none or several may be meant.
    """
    if named is None and not _needs_sheet(cls, state.vocabulary):
        return None
    shipped, short = load_sheets(state.vocabulary), state.vocabulary.short
    if named is not None:
        return _look_up(named, shipped.instances(SHEET) | state.instances(SHEET), short)
    fitting = _list_fitting(cls, shipped)
    found = [each for each in fitting if _is_called_like(each, cls)] or fitting
    if len(found) == 1:
        return found[0]
    listed = f"; there is {', '.join(map(short, found))}" if found else ""
    raise RequestError(f"a {short(cls)} needs a data sheet: name it with `--sheet NAME`{listed}")


def _look_up(name: str, known: frozenset[str], short: Callable[[str], str]) -> str:
    matching = sorted(each for each in known if name in (short(each), local_name(each)))
    if len(matching) == 1:
        return matching[0]
    if matching:
        raise RequestError(f"`{name}` may be {' or '.join(map(short, matching))}: write its prefix, too")
    names = sorted(map(short, known))
    hint = did_you_mean(name, names) or f"there is {', '.join(names)}"
    raise RequestError(f"there is no data sheet `{name}`; {hint}")


def _needs_sheet(cls: str, vocabulary: Vocabulary) -> bool:
    return any(HAS_SHEET in term.required and vocabulary.is_a(cls, iri) for iri, term in vocabulary.classes.items())


def _list_fitting(cls: str, sheets: WorldState) -> list[str]:
    """Return the sheets of the kinds that describe a class, or all if nothing says which these are."""
    kinds = list_sheet_kinds(sheets.vocabulary, cls) or {SHEET}
    return sorted({sheet for kind in kinds for sheet in sheets.instances(kind)})


def _is_called_like(sheet: str, cls: str) -> bool:
    """Whether a sheet is called like a class, as `own-hand-sheet` is called like `OwnHand`."""
    return local_name(sheet).replace("-", "").casefold() == f"{local_name(cls)}sheet".casefold()
