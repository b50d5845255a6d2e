"""Edits that state an individual, named in a task or a test, in its scene: with the class that its place asks for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import pyoxigraph as ox

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.creations import Creation
from skillc_compiler.ide.cursor import InCode, locate_cursor
from skillc_compiler.ide.cursor_context import CursorContext, find_context
from skillc_compiler.ide.expectation import find_expected_type, find_ranges
from skillc_compiler.ide.project_names import SCENE, ProjectNames
from skillc_compiler.program.types import Thing
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source, Span
from skillc_rdf.turtle.editing import Editor
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import THING, Vocabulary

UNKNOWN = "unknown-individual"
"""The problem of an individual that the scene of a task does not have."""
Judge = Callable[[tuple[Fix, ...]], Iterable[Diagnostic]]
"""Returns the problems of the project after edits."""


def find_missing_individuals(names: ProjectNames, problems: Sequence[Diagnostic], judge: Judge) -> Iterator[Creation]:
    """Yield the statement for each of some problems that are an individual that its scene does not have.

    The scene is a file of the project in Turtle, without syntax errors. What it has to say further of an individual
    of the class, such as its size, is an error in it afterwards.
    """
    for problem in problems:
        edit = _state(names, problem.span) if problem.name == UNKNOWN else None
        if edit is not None and _cures(names, edit, problem, tuple(judge((edit,)))):
            yield Creation(problem, edit)


def _state(names: ProjectNames, span: Span) -> Fix | None:
    """Return the edit that states the class of the individual at a place in a task."""
    analysis = names.analysis
    source = Source(span.path, analysis.texts.get(span.path, ""), edition=analysis.edition(span.path))
    cursor = locate_cursor(source, span.line, span.column)
    around = find_context(analysis, span.path, cursor) if isinstance(cursor, InCode) else None
    if not isinstance(cursor, InCode) or around is None or around.task is None:
        return None
    path, iri = names.scenes.get(around.task.name, ""), around.visible.iri(analysis.text_of(span))
    rest = analysis.line(span.path, span.line)[span.end_column - 1 :]
    after = tuple(each for each in tokenize(Source(span.path, rest)).value if each.value)
    cls = _find_class(analysis, around, cursor.before, after)
    text = names.turtle.get(path)
    if iri is None or cls is None or cls == THING or text is None or not path.endswith(".ttl"):
        return None
    if parse(path, text, SCENE).problems:
        return None
    return _add(path, text, iri, cls, analysis.program.vocabulary)


def _add(path: str, text: str, iri: str, cls: str, vocabulary: Vocabulary) -> Fix:
    """Return the edit that adds the statement of a class to a text in Turtle."""
    editor = Editor(text, SCENE, lambda each: vocabulary.aliases.get(each, each))
    editor.add(iri, RDF_TYPE, ox.NamedNode(cls))
    written = f"{editor.format_node(ox.NamedNode(iri))} a {editor.format_node(ox.NamedNode(cls))}"
    pairs = enumerate(zip(text, editor.text, strict=False))
    start = next((at for at, (before, after) in pairs if before != after), len(text))
    added = editor.text[start : len(editor.text) - (len(text) - start)]
    return Fix(Lines(path, text).place(start, start), added, f"state `{written}` in {path}", safe=False)


def _find_class(
    analysis: Analysis, around: CursorContext, before: Sequence[Token], after: Sequence[Token]
) -> str | None:
    """Return the class that the place between tokens asks for: by a parameter, a relation, a property or `is`."""
    expected = find_expected_type(around, analysis.program.skills, before).type
    if isinstance(expected, Thing):
        return expected.cls
    known, visible = around.visible.vocabulary, around.visible
    if len(before) > 1 and visible.term("relation", before[-1].value):
        return next(iter(find_ranges(around, before[-1].value, around.type_of(before[:-1]))), None)
    if not after:
        return None
    if after[0].type in ("DOT", "HAS", "IS") and len(after) > 1:
        iri = visible.read_term(after[1].value)
        term = known.properties.get(iri or "")
        if after[0].type == "IS":
            return visible.term("class", after[1].value)
        return term.domains[0] if term and term.domains else _domain(around, iri)
    return _domain(around, visible.term("relation", after[0].value))


def _domain(around: CursorContext, relation: str | None) -> str | None:
    term = around.visible.vocabulary.relations.get(relation or "")
    return next((each.domain for each in term.signatures), None) if term else None


def _cures(names: ProjectNames, edit: Fix, problem: Diagnostic, after: Sequence[Diagnostic]) -> bool:
    """Whether a problem is gone after an edit, and there are no more errors than before but in the edited scene."""
    elsewhere = [each for each in after if each.severity == "error" and each.span.path in names.analysis.texts]
    same = (problem.name, problem.message)
    errors = sum(each.severity == "error" for each in names.analysis.problems)
    return same not in {(each.name, each.message) for each in after} and len(elsewhere) <= errors
