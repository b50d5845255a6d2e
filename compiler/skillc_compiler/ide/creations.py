"""Edits that declare what is missing: skills and their parameters, terms, values of enumerations, implementations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import takewhile

import msgspec

from skillc_compiler.ide.analysis import Analysis, analyse
from skillc_compiler.ide.cursor import InCode, locate_cursor
from skillc_compiler.ide.cursor_context import CursorContext, find_context
from skillc_compiler.ide.term_pages import format_bare_type
from skillc_compiler.program.types import UNKNOWN, Thing, Type, declared_as
from skillc_compiler.program.unknown import UnknownName
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source, Span
from skillc_dsl.units import UNITS
from skillc_rdf.vocabulary.types import local_name

_ANY = "Thing"
_TERMS = s.ClassDeclaration | s.RelationDeclaration | s.PropertyDeclaration


class Creation(msgspec.Struct, frozen=True):
    """The edit that declares what a problem misses."""

    problem: Diagnostic
    edit: Fix


def find_creations(analysis: Analysis, problems: Sequence[Diagnostic]) -> Iterator[Creation]:
    """Yield an edit for each of some problems that a declaration cures, after which there are no more errors."""
    unknown = {(each.diagnostic, each.written.span): each for each in analysis.program.unknown}
    for problem in problems:
        edit = _declare(analysis, unknown.get((problem.name, problem.span)), problem)
        if edit is not None and _cures(analysis, edit, problem):
            yield Creation(problem, edit)


def _declare(analysis: Analysis, name: UnknownName | None, problem: Diagnostic) -> Fix | None:
    if problem.name == "no-implementation":
        skill = analysis.text_of(problem.span)
        body = f'impl by_stand_in of {skill} {{\n    run python "skillc.primitives:StandIn"\n}}\n'
        return _at_end(analysis, problem.span.path, body, f"add an implementation of `{skill}` that does nothing")
    if name is None or ":" in name.written.text:
        return None
    text, path = name.written.text, name.written.span.path
    match name.kind:
        case "skill":
            return _at_end(analysis, path, _skill(analysis, name.written), f"declare the skill `{text}`")
        case "class":
            return _beside_terms(analysis, path, f"class {text} < {_ANY}", f"declare the class `{text}`")
        case "relation" | "property":
            line = _term(analysis, name.kind, name.written)
            return _beside_terms(analysis, path, line, f"declare the {name.kind} `{text}`") if line else None
        case "value":
            return _value(analysis, name)
        case "argument":
            return _parameter(analysis, name)
        case _:
            return None


def _skill(analysis: Analysis, name: s.Name) -> str:
    """Return the declaration of a skill with the parameters that its call passes."""
    call = next((each for each in analysis.program.calls if each.written.skill.span == name.span), None)
    passed = {each.name.text: each.value.type for each in call.arguments} if call is not None else {}
    lines = [f"    in {parameter}: {_write(analysis, name.span.path, kind)}" for parameter, kind in passed.items()]
    lines += ["    out result: Number"] if call is not None and call.out is not None else []
    return "\n".join((f"skill {name.text} {{", *lines, "    noplan", "}\n"))


def _value(analysis: Analysis, name: UnknownName) -> Fix | None:
    """Return the edit that adds a value to the enumeration that lacks it."""
    places = {(label.span.path, label.span.line) for label in name.labels}
    for unit in analysis.program.files:
        for each in unit.file.declarations:
            if isinstance(each, s.ClassDeclaration) and each.values and (each.span.path, each.span.line) in places:
                text = f"add `{name.written.text}` to `{each.name.text}`"
                return Fix(each.values[-1].span.after, f", {name.written.text}", text, safe=False)
    return None


def _parameter(analysis: Analysis, name: UnknownName) -> Fix | None:
    """Return the edit that declares the parameter that a call passes, with the type of what it passes."""
    skill, written = analysis.program.skills.get(name.owner or ""), name.written
    around = _context(analysis, written.span)
    required = [each for each in skill.parameters if each.direction == "in"] if skill else []
    if skill is None or not required or around is None:
        return None
    rest = _tokens_after(analysis, written.span)
    passed = tuple(takewhile(lambda each: each.type not in ("COMMA", "RPAR"), rest[1:])) if rest[:1] == (":",) else ()
    kind = around.type_of(passed) if passed else around.locals.get(written.text, UNKNOWN)
    place = required[-1].span
    above = analysis.line(place.path, place.line).partition(f"{required[-1].name}:")[0]
    text = f"{above}{written.text}: {_write(analysis, written.span.path, kind)}\n"
    below = Span(place.path, place.line + 1, 1, place.line + 1, 1)
    return Fix(below, text, f"add the parameter `{written.text}` to `{skill.name}`", safe=False)


def _context(analysis: Analysis, span: Span) -> CursorContext | None:
    """Return what can be read at a place."""
    source = Source(span.path, analysis.texts[span.path], edition=analysis.edition(span.path))
    cursor = locate_cursor(source, span.line, span.column)
    return find_context(analysis, span.path, cursor) if isinstance(cursor, InCode) else None


def _tokens_after(analysis: Analysis, span: Span) -> tuple[Token, ...]:
    rest = analysis.line(span.path, span.line)[span.end_column - 1 :]
    return tuple(each for each in tokenize(Source(span.path, rest)).value if each.value)


def _term(analysis: Analysis, kind: str, name: s.Name) -> str | None:
    """Return the declaration of a relation or property, by what stands on both sides of its name."""
    span = name.span
    source = Source(span.path, analysis.texts[span.path], edition=analysis.edition(span.path))
    cursor = locate_cursor(source, span.line, span.column)
    around = find_context(analysis, span.path, cursor) if isinstance(cursor, InCode) else None
    if not isinstance(cursor, InCode) or around is None:
        return None
    after = _tokens_after(analysis, span)
    dotted = cursor.types[-1:] in (("DOT",), ("HAS",))
    subject = _write(analysis, span.path, around.type_of(cursor.before[:-1] if dotted else cursor.before))
    if kind == "property" or dotted:
        return f"property {name.text}({subject}): {_value_type(analysis, around, span.path, after)}"
    object_ = _write(analysis, span.path, around.type_of(after[:1]))
    return f"relation {name.text}({subject}, {object_})"


def _value_type(analysis: Analysis, around: CursorContext, path: str, after: Sequence[Token]) -> str:
    """Return the type of the value that a property is compared with; a truth value where there is none."""
    value = after[1] if len(after) > 1 else None
    if value is None or value.type in ("TRUE", "FALSE"):
        return "Bool"
    if value.type == "QUANTITY":
        unit = UNITS.get(value.value.lstrip("0123456789.eE+-").strip())
        return unit.dimension.name if unit is not None else "Number"
    if value.type == "NAME" and around.locals.get(value.value, UNKNOWN) != UNKNOWN:
        return _write(analysis, path, around.locals[value.value])
    return "Text" if value.type == "STRING" else "Number"


def _write(analysis: Analysis, path: str, kind: Type) -> str:
    """Return a type as a file writes it: that of all things for an unknown one."""
    if isinstance(kind, Thing) and kind.cls is not None:
        visible = analysis.visible[path]
        bare = visible.bare["class"].get(local_name(kind.cls), ())
        return local_name(kind.cls) if tuple(bare) == (kind.cls,) else visible.written(kind.cls) or _ANY
    declared = None if isinstance(kind, Thing) else declared_as(kind)
    return _ANY if declared is None else format_bare_type(declared)


def _at_end(analysis: Analysis, path: str, text: str, message: str) -> Fix:
    rows = analysis.texts[path].split("\n")
    end = Span(path, len(rows), len(rows[-1]) + 1, len(rows), len(rows[-1]) + 1)
    before = "\n\n" if rows[-1] else "\n"
    return Fix(end, before + text, message, safe=False)


def _beside_terms(analysis: Analysis, path: str, line: str, message: str) -> Fix | None:
    """Return the edit that adds a line below the last term of a file, or below its header."""
    file = next((unit.file for unit in analysis.program.files if unit.file.path == path), None)
    if file is None:
        return None
    terms = [each.span.end_line for each in file.declarations if isinstance(each, _TERMS)]
    header = [each.span.end_line for each in file.header]
    last = max(terms or header or [0])
    text = f"{line}\n" if terms else f"\n{line}\n" if header else f"{line}\n\n"
    return Fix(Span(path, last + 1, 1, last + 1, 1), text, message, safe=False)


def _cures(analysis: Analysis, edit: Fix, problem: Diagnostic) -> bool:
    """Whether a problem is gone after an edit, and there are no more errors than before."""
    sources = dict(analysis.library.sources)
    source = sources.get(edit.span.path)
    if source is None:
        return False
    sources[source.path] = source._replace(text=apply_fixes(source.text, [edit]))
    after = analyse(replace(analysis.library, sources=sources), analysis.parsed_by).problems
    same = (problem.name, problem.message)
    return same not in {(each.name, each.message) for each in after} and _errors(after) <= _errors(analysis.problems)


def _errors(problems: Sequence[Diagnostic]) -> int:
    return sum(each.severity == "error" for each in problems)
