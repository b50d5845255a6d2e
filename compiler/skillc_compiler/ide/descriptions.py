"""Descriptions of symbols in Markdown, for hovering."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import assert_never

import msgspec

from skillc_compiler.ide import term_pages
from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.symbols import (
    AggregateSymbol,
    ChoiceSymbol,
    FailurePartSymbol,
    FileSymbol,
    FunctionSymbol,
    ImplementationSymbol,
    IndividualSymbol,
    LabelSymbol,
    LocalSymbol,
    ParameterSymbol,
    PrefixSymbol,
    QuantitySymbol,
    SceneSymbol,
    SkillSymbol,
    Symbol,
    TaskSymbol,
    TermSymbol,
    TypeSymbol,
)
from skillc_compiler.ide.term_pages import format_page
from skillc_compiler.program.labels import declaration_place
from skillc_compiler.program.typed import Parameter, Requirement, Skill, Task, Test
from skillc_compiler.program.types import describe_type
from skillc_dsl import syntax as s
from skillc_dsl.descriptions.constructs import find_construct, find_constructs
from skillc_dsl.descriptions.rows import Construct
from skillc_dsl.source import Span
from skillc_dsl.token_table import scan_tokens
from skillc_rdf.vocabulary.types import local_name

_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
"""A link of Markdown, which leads nowhere in an editor."""


def describe_symbol(analysis: Analysis, symbol: Symbol) -> str:
    """Return the description of a symbol in Markdown, or an empty string for an unknown one."""
    vocabulary = analysis.program.vocabulary
    match symbol:
        case TermSymbol(kind=kind, iri=iri):
            return term_pages.term_page(vocabulary, kind, iri, _range_of(analysis, iri))
        case TypeSymbol(name=name):
            return term_pages.type_page(name)
        case FunctionSymbol(name=name):
            return term_pages.function_page(vocabulary.functions[name]) if name in vocabulary.functions else ""
        case ChoiceSymbol(text=text, iri=value):
            return term_pages.choice_page(vocabulary, text, value)
        case FailurePartSymbol(name=name):
            return f"`{name}`: {term_pages.FAILURE[name]}" if name in term_pages.FAILURE else ""
        case AggregateSymbol(name=name):
            return term_pages.describe_aggregate(name)
        case QuantitySymbol(value=value, unit=unit):
            return term_pages.quantity_page(value, unit)
        case PrefixSymbol(name=name):
            return format_page(f"prefix {name}: <{vocabulary.prefixes[name]}>") if name in vocabulary.prefixes else ""
        case IndividualSymbol(iri=iri):
            return _individual(analysis, iri)
        case FileSymbol(path=path) | SceneSymbol(name=path):
            return f"`{path}`"
        case _:
            return _of_program(analysis, symbol)


def format_parameter(analysis: Analysis, parameter: Parameter) -> str:
    """Return a parameter in the syntax of its declaration."""
    direction = f"{parameter.direction} any" if parameter.any_ else parameter.direction
    default = f" = {analysis.text_of(parameter.default.span)}" if parameter.default else ""
    low, high = parameter.low, parameter.high
    bounds = f" range {analysis.text_of(low.span)} .. {analysis.text_of(high.span)}" if low and high else ""
    return f"{direction} {parameter.name}: {term_pages.format_bare_type(parameter.declared)}{default}{bounds}"


_OfProgram = SkillSymbol | ImplementationSymbol | TaskSymbol | ParameterSymbol | LocalSymbol | LabelSymbol


def _of_program(analysis: Analysis, symbol: _OfProgram) -> str:
    match symbol:
        case SkillSymbol(name=name):
            found = analysis.program.skills.get(name)
            return _skill(analysis, found) if found else ""
        case ImplementationSymbol(skill=skill, name=name):
            doc = next((i.doc for i in analysis.program.implementations if i.key == f"{skill}.{name}"), "")
            return format_page(f"impl {name} of {skill}", doc)
        case TaskSymbol(name=name):
            return _task(name, next((task for task in analysis.program.tasks if task.name == name), None))
        case ParameterSymbol():
            return _parameter(analysis, symbol)
        case LocalSymbol():
            return _local(analysis, symbol)
        case LabelSymbol():
            return _label(analysis, symbol)
        case _:
            assert_never(symbol)


def _task(name: str, task: Task | None) -> str:
    declared = task.parameters if task else ()
    parameters = ", ".join(f"{each.name}: {term_pages.format_bare_type(each.declared)}" for each in declared)
    head = f"test {name}" if isinstance(task, Test) else f"task {name}"
    return format_page(f"{head}({parameters})" if parameters else head, task.doc if task else "")


def _skill(analysis: Analysis, skill: Skill) -> str:
    lines = [f"    {format_parameter(analysis, parameter)}" for parameter in skill.parameters]
    lines += [
        _taken_line(each) if each.taken_from else f"    {analysis.text_of(each.span)}" for each in skill.requirements
    ]
    lines += [f"    senses {analysis.text_of(value.span)}" for value in skill.senses]
    lines += [f"    {analysis.text_of(skill.pause.span)}"] if skill.pause else []
    ways = [way.name for way in analysis.program.implementations_of.get(skill.name, ())]
    found = f"implementations: {', '.join(f'`{way}`' for way in ways)}" if ways else "no implementation here"
    return format_page("\n".join((f"skill {skill.name}", *lines)), skill.doc, found)


def _range_of(analysis: Analysis, iri: str) -> str:
    """Return the range of a property as the library declares it, an empty text if it declares none."""
    term = analysis.program.vocabulary.properties.get(iri)
    place = declaration_place(term) if term is not None and term.bounds is not None else None
    declared = (each for unit in analysis.program.files for each in unit.file.declarations)
    ranges = (
        each.range
        for each in declared
        if isinstance(each, s.PropertyDeclaration) and place is not None
        if (each.span.path, each.span.line) == (place.path, place.line)
    )
    return next((f"in the {analysis.text_of(each.span)}" for each in ranges if each is not None), "")


def _parameter(analysis: Analysis, symbol: ParameterSymbol) -> str:
    skill = analysis.program.skills.get(symbol.skill)
    parameter = skill.parameter(symbol.name) if skill else None
    if parameter is None:
        return ""
    return format_page(format_parameter(analysis, parameter), parameter.doc, f"parameter of `{symbol.skill}`")


def _local(analysis: Analysis, symbol: LocalSymbol) -> str:
    places = [occurrence.span for occurrence in analysis.index.of(symbol)]
    kinds = [describe_type(analysis.types[place]) for place in places if place in analysis.types]
    lets = (let for way in analysis.program.implementations for let in way.lets)
    value = next((let.value for let in lets if let.name.span in places), None)
    if value is not None:
        return format_page(f"let {symbol.name} = {analysis.text_of(value.span)}", describe_type(value.type))
    return f"`{symbol.name}`: the {symbol.origin}" + (f", {kinds[0]}" if kinds else "")


def _label(analysis: Analysis, symbol: LabelSymbol) -> str:
    found = next((r for r in _requirements(analysis, symbol.owner) if r.label and r.label.text == symbol.name), None)
    return format_page(analysis.text_of(found.span), f"condition of `{symbol.owner}`") if found else ""


def _requirements(analysis: Analysis, owner: str) -> tuple[Requirement, ...]:
    skill = analysis.program.skills.get(owner)
    if skill is not None:
        return skill.requirements
    return next((way.requirements for way in analysis.program.implementations if way.key == owner), ())


def _individual(analysis: Analysis, iri: str) -> str:
    classes = {cls for scene in analysis.library.scenes.values() for cls in scene.get(iri, ())}
    above = {one for one in classes for other in classes - {one} if analysis.program.vocabulary.is_a(other, one)}
    kinds = f", {term_pages.format_names(sorted(classes - above))}" if classes else ""
    return f"the individual `{local_name(iri)}`{kinds}\n\n`{iri}`"


class Hover(msgspec.Struct, frozen=True):
    """The Markdown shown when hovering over a place."""

    span: Span
    markdown: str


def find_hover(analysis: Analysis, path: str, line: int, column: int) -> Hover | None:
    """Return the description of the name at a place, or of the keyword that stands there.

    A shorthand argument has those of the parameter and of the local name.
    """
    there = analysis.index.at(path, line, column)
    if not there:
        return _keyword(analysis, path, line, column)
    span = there[0].span
    texts = [describe_symbol(analysis, occurrence.symbol) for occurrence in there if occurrence.span == span]
    texts += _taken_over(analysis, span)
    distinct = list(dict.fromkeys(text for text in texts if text))
    return Hover(span, "\n\n---\n\n".join(distinct)) if distinct else None


def _taken_over(analysis: Analysis, span: Span) -> Iterator[str]:
    """Yield what a `pre of` stands for whose skill is named at a place."""
    for skill in analysis.program.skills.values():
        for taken in (each for each in skill.taken_over if each.call.written.skill.span == span):
            place = taken.call.written.span
            found = [each for each in skill.parameters if each.name in taken.names]
            lines = [f"    {format_parameter(analysis, each)}" for each in found]
            lines += [_taken_line(each) for each in skill.requirements if each.taken_from and each.span == place]
            yield format_page("\n".join(("pre of it, which stands for", *lines)))


def _taken_line(requirement: Requirement) -> str:
    return f"    pre {requirement.text}"


def _keyword(analysis: Analysis, path: str, line: int, column: int) -> Hover | None:
    text = analysis.line(path, line)
    for kind, start, word in scan_tokens(text):
        if kind == "name" and start < column <= start + len(word):
            found = find_construct(word, text)
            if found is None or (line, start + 1) in analysis.words_as_names(path):
                return None
            return Hover(Span(path, line, start + 1, line, start + 1 + len(word)), _of_construct(word, found))
    return None


def describe_keyword(word: str) -> str:
    """Return the forms and meanings of what has a keyword, in Markdown; empty for other words."""
    return "\n\n---\n\n".join(_of_construct(word, each) for each in find_constructs(word))


def _of_construct(word: str, construct: Construct) -> str:
    return format_page(construct.written.replace("`", "") or word, _LINK.sub(r"\1", construct.meaning))
