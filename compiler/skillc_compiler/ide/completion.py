"""Completion at the cursor: keywords from the grammar, names from the surrounding declaration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import msgspec

from skillc_compiler.ide import offers
from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.calls import find_open_call
from skillc_compiler.ide.cursor import Cursor, InBraces, InCode, InComment, InText, locate_cursor
from skillc_compiler.ide.cursor_context import CursorContext, find_context
from skillc_compiler.ide.descriptions import describe_keyword
from skillc_compiler.ide.expectation import CHANGES, find_expected_type, find_ranges
from skillc_compiler.ide.offers import Offer
from skillc_compiler.ide.term_pages import AGGREGATE_FORMS, format_bare_type
from skillc_compiler.program.types import MESSAGE, UNKNOWN, Measure, Thing, Type, describe_type
from skillc_compiler.resolve.references import ExpectedType
from skillc_dsl.descriptions.constructs import CONSTRUCTS
from skillc_dsl.editions import NEWEST
from skillc_dsl.parsing.grammar import END, fixed_texts, list_fitting_terminals, shift
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source, Span
from skillc_dsl.token_table import SINCE, list_later_words
from skillc_dsl.units import UNITS

_BEGINNING = frozenset(each.words[0].text for each in CONSTRUCTS if each.group in ("declaration", "member", "flag"))
_DECLARATIONS = frozenset(each.words[0].text for each in CONSTRUCTS if each.group == "declaration")
_LATER = tuple((word.upper(),) for word in sorted(_DECLARATIONS & SINCE.keys()))
_VALUES = frozenset(("true", "false"))
_CLASS_LISTS = {"CLASS": ("LESS", "DISJOINT", "COMMA"), "RELATION": ("LPAR", "COMMA", "LABEL"), "PROPERTY": ("LPAR",)}


class Completion(msgspec.Struct, frozen=True):
    """The offered words, and the place that the chosen one replaces."""

    replaced: Span
    offers: tuple[Offer, ...]


def complete(
    analysis: Analysis,
    path: str,
    line: int,
    column: int,
    scenes: Sequence[str] = (),
    warnings: Sequence[str] = (),
    backends: Sequence[str] = (),
) -> Completion:
    """Return the completion at a place.

    `scenes` are the names of the available scenes, `warnings` those of the diagnostics that can be allowed, `backends`
    those of the back ends that are installed."""
    source = Source(path, analysis.texts.get(path, ""), edition=analysis.edition(path))
    cursor = locate_cursor(source, line, column)
    if isinstance(cursor, InCode) and cursor.types[:1] == ("TASK",) and cursor.types[-1:] == ("BACKEND",):
        return Completion(cursor.word, tuple(Offer(name, "value", "back end") for name in sorted(backends)))
    found = tuple(_offers(analysis, path, cursor, scenes, warnings))
    ranked = sorted(dict.fromkeys(found), key=lambda offer: (offer.rank, offer.text))
    return Completion(cursor.word, tuple(ranked))


def _offers(
    analysis: Analysis, path: str, cursor: Cursor, scenes: Sequence[str], warnings: Sequence[str]
) -> Iterator[Offer]:
    match cursor:
        case InComment(text=text):
            if text.lstrip("#").split()[:1] == ["allow"] and ":" not in text:
                yield from (Offer(name, "diagnostic") for name in warnings)
        case InText(opener="import"):
            names = [name for name in (*analysis.library.sources, *analysis.library.importable) if name != path]
            yield from (Offer(name, "file", written=f'"{name}') for name in dict.fromkeys(names))
        case InText(opener="scene"):
            yield from (Offer(name, "file", "scene", written=f'"{name}') for name in scenes)
        case InText():
            return
        case InBraces(around=code):
            around = find_context(analysis, path, code)
            if around is not None:
                yield from _in_braces(analysis, around, cursor)
        case InCode():
            around = find_context(analysis, path, cursor)
            if around is not None:
                yield from _in_code(analysis, around, cursor)


def _in_code(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    if cursor.number:
        wanted = find_expected_type(around, analysis.program.skills, cursor.before[:-1]).type
        fits_here = {wanted.dimension} if isinstance(wanted, Measure) else {unit.dimension for unit in UNITS.values()}
        yield from (Offer(name, "unit", u.dimension.name) for name, u in UNITS.items() if u.dimension in fits_here)
        return
    yield from _names(analysis, around, cursor)
    yield from offer_keywords(cursor, analysis.edition(cursor.word.path))


def _in_braces(analysis: Analysis, around: CursorContext, cursor: InBraces) -> Iterator[Offer]:
    """Offer what may stand in braces in a text: a name, or a member of it."""
    before = cursor.around.before
    wanted = find_expected_type(around, analysis.program.skills, before).type
    if cursor.around.types[-1:] != ("FAIL",) and wanted != MESSAGE:
        return
    if cursor.of in _failures(before):
        yield from offers.offer_parts_of_failure()
    elif cursor.of:
        yield from offers.offer_properties(around, around.locals.get(cursor.of, UNKNOWN))
    else:
        yield from (Offer(name, "variable", describe_type(kind)) for name, kind in around.locals.items())


def offer_keywords(cursor: InCode, edition: int = NEWEST) -> Iterator[Offer]:
    """Offer the keywords that the grammar accepts, except as names; members only at the beginning of a line.

    Of those that came after the `edition` only what a later declaration begins with, or has in it.
    """
    later = list_later_words(edition) - _DECLARATIONS if cursor.types[:1] not in _LATER else frozenset()
    as_name = shift(cursor.states, "NAME")
    after_name = list_fitting_terminals(as_name) if as_name else frozenset()
    here = list_fitting_terminals(cursor.states)
    beginning = _BEGINNING if here & {"RBRACE", END} and not cursor.begins_line else frozenset()
    for terminal in sorted(here):
        if terminal == "OF" and here != {"OF"} and cursor.before[-1].value != "Vector":
            continue
        text = fixed_texts().get(terminal, "")
        after = shift(cursor.states, terminal) if text.isalpha() and text not in beginning | _VALUES | later else None
        if after is not None and (as_name is None or list_fitting_terminals(after) != after_name):
            yield Offer(text, "keyword", documentation=describe_keyword(text), rank=5)


def _names(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    """Offer names, selected by the kind of declaration and by the last token before the cursor."""
    types = cursor.types
    match types[:1], types[-1:]:
        case ("USE",), _:
            written = {token.value for token in cursor.before}
            yield from (Offer(p, "vocabulary") for p in analysis.library.vocabulary.prefixes if p not in written)
        case ("RELATION",), _ if "EQUAL" in types:
            yield from _in_members(analysis, around, cursor)
        case (head,), (last,) if last in _CLASS_LISTS.get(head, ()):
            yield from _classes(analysis, around, cursor)
        case ("RELATION",), ("INVERSE" | "SUB",):
            yield from offers.offer_all_relations(around)
        case ("PROPERTY" | "FUNCTION",), ("COLON" | "LABEL" | "ARROW" | "LSQB",):
            yield from _types(analysis, around, cursor)
        case ("PROPERTY" | "FUNCTION",), ("OF",):
            yield from offers.offer_dimensions()
        case ("TASK",), ("LABEL",) if "LBRACE" not in types:
            yield from _types(analysis, around, cursor)
        case ("SKILL" | "IMPL" | "TASK" | "TEST",), _:
            yield from _in_members(analysis, around, cursor)


def _in_members(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    before, types = cursor.before, cursor.types
    match types:
        case ("IMPL", _, "OF"):
            yield from offers.offer_skills(analysis, around)
            yield from offers.offer_unimported_skills(analysis, cursor.word.path)
        case (*_, "LABEL", _, "OF") | (*_, "LABEL", "LSQB", _, "OF"):
            yield from offers.offer_dimensions()
        case (*_, ("IN" | "OPT" | "INFER" | "ANY" | "OUT"), "LABEL") | (*_, "LABEL", "LSQB"):
            yield from _types(analysis, around, cursor)
        case (*_, "REFINE", "LABEL"):
            yield from _narrower(analysis, around, cursor, before[-1].value.rstrip(":"))
        case (*_, "REFINE"):
            yield from _refinable(analysis, around, before)
        case (*_, "IS") | (*_, ("EXISTS" | "FORALL" | "FOR" | "SOME"), "LABEL"):
            yield from _classes(analysis, around, cursor)
        case (*_, "LPAR", "LABEL") if len(before) > 2 and before[-3].value in AGGREGATE_FORMS:
            yield from _classes(analysis, around, cursor)
        case (*_, ("USES" | "SHARES")):
            yield from offers.offer_parameters(analysis, around.skill.parameters if around.skill else ())
        case (*_, "GIVEN"):
            optional = (p for p in (around.skill.parameters if around.skill else ()) if p.direction == "opt")
            yield from offers.offer_parameters(analysis, optional)
        case (*_, "DOT") if len(before) > 1 and before[-2].value in _failures(before):
            yield from offers.offer_parts_of_failure()
        case (*_, ("DOT" | "HAS")):
            yield from offers.offer_properties(around, around.type_of(before[:-1]))
            yield from offers.offer_hidden_terms(analysis, cursor.word.path, "property", around.type_of(before[:-1]))
        case _:
            yield from _in_lines(analysis, around, cursor)


def _is_quantified(types: Sequence[str]) -> bool:
    """Whether a label is that of a further variable of a quantifier."""
    first = len(types) - 1
    while first > 2 and types[first - 1] == "COMMA" and types[first - 3] == "LABEL":
        first -= 3
    return types[first - 1] in ("EXISTS", "FORALL")


def _in_lines(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    """Offer what fits in heads of quantifiers, in lines of tests, in `verify` and `senses`, and where values stand."""
    match cursor.types:
        case (*_, "COMMA", "LABEL") if _is_quantified(cursor.types):
            yield from _classes(analysis, around, cursor)
        case ("TEST", *_, "START"):
            yield from offers.offer_uncertain_skills(analysis, around)
            yield from _in_values(analysis, around, cursor)
        case ("TEST", *_, "EXPECT", "NO" | "FAILURE"):
            return
        case (*_, "VERIFY" | "NEVER" | "AFTER" | "OUTSIDE" | "BEFORE" | "EVENTUALLY"):
            yield from offers.offer_skills(analysis, around)
            yield from _in_values(analysis, around, cursor)
        case ("TEST", *_, "START", _, "ARROW"):
            yield from offers.offer_outcomes(analysis, cursor.before[-2].value)
        case (*_, "ARROW") | ("IMPL", *_, "OUT"):
            outputs = (p for p in (around.skill.parameters if around.skill else ()) if p.direction == "out")
            yield from offers.offer_parameters(analysis, outputs)
        case (*_, "SENSES"):
            things = (p for p in (around.skill.parameters if around.skill else ()) if isinstance(p.type, Thing))
            yield from offers.offer_parameters(analysis, things)
        case _:
            yield from _in_values(analysis, around, cursor)


def _in_values(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    before, types = cursor.before, cursor.types
    call = find_open_call(before)
    if _applies(types):
        return _labels(around)
    if types[-2:] == ("NAME", "LSQB"):
        ways = analysis.program.implementations_of.get(before[-2].value, ())
        return (Offer(way.name, "implementation", documentation=way.doc) for way in ways)
    if call and types[-1] in ("LPAR", "COMMA") and call.name in analysis.program.skills:
        return offers.offer_arguments(analysis, around, call.name, call.passed)
    if cursor.fits("NAME", "UNDERSCORE"):
        return _relations(analysis, around, cursor)
    if types[-1] in CHANGES:
        return _values(analysis, around, cursor)
    if cursor.fits("UNDERSCORE") and not cursor.fits("UNDERSCORE", "SENSED"):
        return _in_range(around, before)
    if cursor.fits("NAME", "LSQB"):
        return _called(analysis, around, cursor)
    if types[0] == "SKILL" and types[-1] in ("EQUAL", "RANGE", "DOTS"):
        return offers.offer_constants(around, find_expected_type(around, analysis.program.skills, before))
    if cursor.fits("NAME", "DOT"):
        return _values(analysis, around, cursor)
    return iter(())


def _relations(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    subject = around.type_of(cursor.before)
    yield from offers.offer_relations(around, subject)
    yield from offers.offer_hidden_terms(analysis, cursor.word.path, "relation", subject)


def _values(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    wanted = find_expected_type(around, analysis.program.skills, cursor.before)
    yield from offers.offer_values(around, wanted)
    yield from offers.offer_unimported_functions(analysis, cursor.word.path, wanted)


def _in_range(around: CursorContext, before: Sequence[Token]) -> Iterator[Offer]:
    """Offer the individuals and names that a relation may lead to."""
    for cls in find_ranges(around, before[-1].value, around.type_of(before[:-1])):
        yield from offers.offer_values(around, ExpectedType(Thing(cls)))


def _called(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    """Offer the skills that a step may call."""
    scoped = cursor.types[-1] == "WITH"
    yield from offers.offer_skills(analysis, around, scoped=scoped)
    yield from offers.offer_unimported_skills(analysis, cursor.word.path, scoped=scoped)


def _classes(analysis: Analysis, around: CursorContext, cursor: InCode, below: Type = UNKNOWN) -> Iterator[Offer]:
    yield from offers.offer_classes(around, below)
    yield from offers.offer_hidden_terms(analysis, cursor.word.path, "class", below)


def _types(analysis: Analysis, around: CursorContext, cursor: InCode) -> Iterator[Offer]:
    yield from _classes(analysis, around, cursor)
    yield from offers.offer_built_in_types()


def _narrower(analysis: Analysis, around: CursorContext, cursor: InCode, name: str) -> Iterator[Offer]:
    """Offer the types that may refine a parameter."""
    parameter = around.skill.parameter(name) if around.skill else None
    if parameter is None:
        yield from _types(analysis, around, cursor)
    elif isinstance(parameter.type, Thing):
        yield from _classes(analysis, around, cursor, parameter.type)
    else:
        yield Offer(format_bare_type(parameter.declared), "type", "built in", rank=1)


def _refinable(analysis: Analysis, around: CursorContext, before: Sequence[Token]) -> Iterator[Offer]:
    taken = {label.value.rstrip(":") for word, label in pairwise(before) if word.type == "REFINE"}
    left = [p for p in (around.skill.parameters if around.skill else ()) if p.name not in taken]
    for offer in offers.offer_parameters(analysis, left):
        yield Offer(f"{offer.text}:", offer.kind, offer.detail, offer.documentation, f"{offer.text}: ")


def _failures(before: Sequence[Token]) -> frozenset[str]:
    """Return the names of failures that are handled in a declaration up to here."""
    return frozenset(name.value for word, name in pairwise(before) if word.type == "AS")


def _applies(types: Sequence[str]) -> bool:
    """Whether the cursor is where `apply LABEL, ..` expects a label."""
    rest = list(types)
    while len(rest) > 1 and rest[-1] == "COMMA":
        del rest[-2:]
    return rest[-1:] == ["APPLY"]


def _labels(around: CursorContext) -> Iterator[Offer]:
    own = around.implementation.requirements if around.implementation else ()
    for requirement in (*(around.skill.requirements if around.skill else ()), *own):
        if requirement.label is not None and requirement.kind == "post":
            yield Offer(requirement.label.text, "label", requirement.text)
