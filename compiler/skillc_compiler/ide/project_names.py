"""The names in all texts of a project: its skills, what is written in Turtle, and the goals of its manifest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.bodies import BodyContext, BodyOccurrences
from skillc_compiler.ide.index import covers
from skillc_compiler.ide.places import find_declarations
from skillc_compiler.ide.symbols import ChoiceSymbol, IndividualSymbol, Occurrence, Symbol, TermSymbol
from skillc_compiler.ide.visible import VisibleNames
from skillc_compiler.resolve.names import bare_terms
from skillc_dsl import syntax as s
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source, Span
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.names import find_names, group_names
from skillc_rdf.vocabulary.types import Vocabulary, value_name

SCENE = "file:///scene"
"""What relative IRIs in a scene are resolved against."""
LINES_ABOVE = 2


class NamedGoal(msgspec.Struct, frozen=True):
    """A goal or a call in a manifest, and where its text begins, from 1."""

    kind: Literal["goal", "do"]
    text: str
    path: str
    line: int
    column: int


class FixedText(msgspec.Struct, frozen=True):
    """A text that names things and is not edited; `reason` completes `it is named in PATH, ..`."""

    text: str
    reason: str


@dataclass(frozen=True)
class ProjectNames:
    """An analysed library with the texts of its project beside the skills, by path.

    `turtle` can be edited, unlike what is `outside` of the project, which is in Turtle too, and what is `fixed`.
    `goals` are those in the `manifest`; `scenes` has the path of each task's and test's scene.
    """

    analysis: Analysis
    turtle: Mapping[str, str] = field(default_factory=dict)
    outside: Mapping[str, str] = field(default_factory=dict)
    fixed: Mapping[str, FixedText] = field(default_factory=dict)
    goals: tuple[NamedGoal, ...] = ()
    manifest: Mapping[str, str] = field(default_factory=dict)
    scenes: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def texts(self) -> Mapping[str, str]:
        """The texts by path."""
        return {**self.analysis.texts, **self.in_turtle, **self.manifest}

    @cached_property
    def in_turtle(self) -> Mapping[str, str]:
        """The texts in Turtle by path."""
        return {**self.outside, **self.turtle}

    def of(self, symbol: Symbol) -> tuple[Occurrence, ...]:
        """Return the occurrences of a symbol in all texts; in Turtle it is declared where its class is stated."""
        beside = (*self._find_in_turtle(symbol), *(each for each in self._in_goals if each.symbol == symbol))
        return (*self.analysis.index.of(symbol), *beside)

    def declarations(self, symbol: Symbol) -> Iterator[Occurrence]:
        """Yield the occurrences that declare a symbol."""
        return (occurrence for occurrence in self.of(symbol) if occurrence.declares)

    def at(self, path: str, line: int, column: int) -> tuple[Occurrence, ...]:
        """Return the occurrences of the name at a place; two if it is an argument that is short for `name: name`."""
        if path in self.in_turtle:
            there = tuple(each for each in self._list_in_turtle(path) if covers(each, line, column))
        elif path in self.manifest:
            there = tuple(each for each in self._in_goals if covers(each, line, column))
        else:
            there = self.analysis.index.at(path, line, column)
        return tuple(occurrence for occurrence in there if occurrence.span == there[0].span)

    def _find_in_turtle(self, symbol: Symbol) -> Iterator[Occurrence]:
        iri = symbol.iri if isinstance(symbol, TermSymbol | ChoiceSymbol | IndividualSymbol) else ""
        aliases = self.analysis.program.vocabulary.aliases
        iris = [iri, *(alias for alias, term in aliases.items() if term == iri)] if iri else []
        for path, text in self.in_turtle.items():
            found = [name for each in iris for name in group_names(text, SCENE).get(each, ())]
            if not found:
                continue
            lines = Lines(path, text)
            yield from (Occurrence(lines.place(*each.extent), symbol, each.typed) for each in found)

    def _list_in_turtle(self, path: str) -> Iterator[Occurrence]:
        lines, vocabulary = Lines(path, self.in_turtle[path]), self.analysis.program.vocabulary
        for name in find_names(self.in_turtle[path], SCENE):
            yield Occurrence(lines.place(*name.extent), symbol_of(vocabulary, name.iri), name.typed)

    @cached_property
    def _in_goals(self) -> tuple[Occurrence, ...]:
        return tuple(each for goal in self.goals for each in _find_in_goal(goal, self._visible))

    @cached_property
    def unread_goals(self) -> tuple[NamedGoal, ...]:
        """The goals that are in another syntax, or have errors, so that their names are not known."""
        return tuple(each for each in self.goals if _parse_goal(each) is None)

    @cached_property
    def _visible(self) -> VisibleNames:
        """What a goal sees: all terms by their bare names, those that the skills see first."""
        found, own = self.analysis.program.vocabulary, self.analysis.visible
        bare = bare_terms(found, found.prefixes)
        for unit in self.analysis.program.files:
            if unit.file.path in self.analysis.library.sources:
                bare = {kind: {**table, **own[unit.file.path].bare[kind]} for kind, table in bare.items()}
        prefixes = {prefix: base for each in own.values() for prefix, base in each.prefixes.items()}
        skills = frozenset(self.analysis.program.skills)
        return VisibleNames(bare, {**prefixes, **found.prefixes}, frozenset(found.functions), skills, found)


def find_definitions(names: ProjectNames, path: str, line: int, column: int) -> tuple[Span, ...]:
    """Return the declarations of the name at a place: in a `.skill` file, the ontology, or where its class is stated.

    A class, relation or property that is declared has no more of them in Turtle.
    """
    found: dict[Span, None] = {}
    for occurrence in names.at(path, line, column):
        declared = find_declarations(names.analysis, occurrence.symbol)
        stated = (each.span for each in names.declarations(occurrence.symbol))
        found |= dict.fromkeys(declared or stated)
    return tuple(found)


def find_references(names: ProjectNames, path: str, line: int, column: int, declarations: bool) -> tuple[Span, ...]:
    """Return all references to the name at a place, with its declarations if `declarations` is true."""
    symbols = {occurrence.symbol for occurrence in names.at(path, line, column)}
    places = (each for symbol in symbols for each in names.of(symbol) if declarations or not each.declares)
    return tuple(sorted({occurrence.span for occurrence in places}))


def symbol_of(vocabulary: Vocabulary, iri: str) -> Symbol:
    """Return what an IRI in Turtle stands for: a term, a value of an enumeration, or else an individual."""
    known = vocabulary.aliases.get(iri, iri)
    if known in vocabulary.classes:
        return TermSymbol("class", known)
    if known in vocabulary.relations:
        return TermSymbol("relation", known)
    if known in vocabulary.properties:
        return TermSymbol("property", known)
    return ChoiceSymbol(value_name(known), known) if known in vocabulary.enumerated else IndividualSymbol(known)


def _find_in_goal(goal: NamedGoal, visible: VisibleNames) -> Iterator[Occurrence]:
    """Yield the occurrences in a goal or call; there are none in one that is not read."""
    task = _parse_goal(goal)
    if task is None:
        return
    walk = BodyOccurrences(visible, {}, frozenset())
    found = [*walk.condition({}, task.goal)] if task.goal is not None else []
    found += walk.node(BodyContext(task.span), {}, task.body.node) if task.body is not None else ()
    for each in found:
        symbol, place = _chosen(each.symbol, visible.vocabulary), _in_manifest(goal, each.span)
        yield msgspec.structs.replace(each, symbol=symbol, span=place)


def _parse_goal(goal: NamedGoal) -> s.TaskDeclaration | None:
    """Return the task of a goal or call in the syntax of the language, None if it is in another or has errors."""
    parsed = parse(Source(goal.path, f"task goal {{\n{goal.kind}\n{goal.text}\n}}\n"))
    match parsed.value:
        case s.File(declarations=[s.TaskDeclaration() as task]) if not parsed.diagnostics:
            return task
        case _:
            return None


def _chosen(symbol: Symbol, vocabulary: Vocabulary) -> Symbol:
    """Return a bare value as that of the only enumeration that has it, if it is one."""
    if not isinstance(symbol, ChoiceSymbol) or symbol.iri:
        return symbol
    values = [iri for iri in vocabulary.enumerated if value_name(iri) == symbol.text]
    return ChoiceSymbol(symbol.text, values[0]) if len(values) == 1 else symbol


def _in_manifest(goal: NamedGoal, span: Span) -> Span:
    """Return a place of the task around a goal as that in the manifest."""

    def moved(line: int, column: int) -> tuple[int, int]:
        row = line - LINES_ABOVE
        return goal.line + row - 1, column + (goal.column - 1 if row == 1 else 0)

    return Span(goal.path, *moved(span.line, span.column), *moved(span.end_line, span.end_column))
