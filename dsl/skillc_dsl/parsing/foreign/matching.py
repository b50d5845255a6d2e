"""Recognizes a form of another language at a token that does not fit, and says what is written here instead."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from skillc_dsl.diagnostics import Fix, ForeignForm
from skillc_dsl.parsing.foreign import conditions, declarations, steps
from skillc_dsl.parsing.foreign.form import Form
from skillc_dsl.parsing.grammar import begins_line, can_continue
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.repairs import Fault
from skillc_dsl.source import Span

FORMS = (*declarations.FORMS, *steps.FORMS, *conditions.FORMS)
_LONGEST = 200
"""The maximum length of a line in which forms are looked for, which bounds the time."""


def report_foreign_form(fault: Fault, lines: Sequence[str]) -> ForeignForm | None:
    """Return the problem if the line of the fault, or the one before it that is not complete, has such a form."""
    places = [*_places(fault)]
    for form in FORMS:
        if form.where and not can_continue(fault.states, form.where):
            continue
        for place in places:
            found = _find(form, lines[place.line - 1], place)
            if found is not None:
                return _problem(form, found, place, fault)
    return None


def _places(fault: Fault) -> Iterator[Span]:
    """Yield where a form may stand that has this fault: at the token and the one before it."""
    here = fault.span
    if not fault.index:
        yield here
        return
    before = token_span(fault.tokens[fault.index - 1], fault.path)
    if begins_line(fault.tokens, fault.index):
        yield from (here, before)
    else:
        yield before.to(here)


def _find(form: Form, line: str, place: Span) -> re.Match[str] | None:
    """Return a match that touches a place in the line, and that is not written already as it should be."""
    if len(line) > _LONGEST:
        return None
    found = form.find_in(line.partition(" #")[0].rstrip())
    start, end = place.column - 1, place.end_column - 1
    near = (each for each in found if each.start("form") <= end and each.end("form") >= start)
    return next((each for each in near if not _is_right(form, each)), None)


def _is_right(form: Form, found: re.Match[str]) -> bool:
    return form.write is not None and found.expand(form.write).split() == found["form"].split()


def _problem(form: Form, found: re.Match[str], place: Span, fault: Fault) -> ForeignForm:
    start, end = found.span("form")
    span = Span(place.path, place.line, start + 1, place.line, end + 1)
    message = f"`{found['form'].strip()}` is not a form of this language"
    if form.write is None:
        return ForeignForm("syntax", span, message, found.expand(form.advice))
    text = found.expand(form.write)
    shown = " ".join(text.split())
    asked = f"write `{shown}`" if shown else "delete it"
    fix = Fix(span, text, asked, safe=False)
    if start == end:
        return ForeignForm("syntax", fault.span, f"`{shown}` is missing before `{fault.token}`", asked, fix=fix)
    return ForeignForm("syntax", span, message, found.expand(form.advice) or asked, fix=fix)
