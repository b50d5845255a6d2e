"""The analysis of a library for an editor: its program, its diagnostics and the index of its names, despite errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from skillc_compiler.diagnostics.fixes import keep_useful_fixes
from skillc_compiler.ide.index import Index, build_index
from skillc_compiler.ide.visible import VisibleNames, find_visible
from skillc_compiler.pipeline import NO_SCENES, lower_and_report
from skillc_compiler.problems import find_problems
from skillc_compiler.program.program import ParsedFile, Program
from skillc_compiler.program.types import Type
from skillc_compiler.resolve.files import NO_NAMESPACES, Parser, read_sources
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.editions import NEWEST
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.parser import parse
from skillc_dsl.parsing.table_types import WORD
from skillc_dsl.query import Memo
from skillc_dsl.source import Source, Span
from skillc_dsl.token_table import list_later_words
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary


@dataclass(frozen=True, slots=True)
class AnalysisInput:
    """The input of an analysis: the sources of a library, the importable files, the ontology, the scenes of its tasks.

    `sources` are keyed by path relative to the library, `importable` by the name written in the import, `namespaces` by
    library.
    """

    name: str
    sources: Mapping[str, Source]
    importable: Mapping[str, Source]
    vocabulary: Vocabulary
    scenes: Mapping[str, Individuals] = field(default_factory=lambda: dict(NO_SCENES))
    namespaces: Mapping[str, str] = field(default_factory=lambda: dict(NO_NAMESPACES))


@dataclass(frozen=True)
class Analysis:
    """A library with the result of parsing and resolving it; everything else is computed on first use."""

    library: AnalysisInput
    files: Outcome[tuple[ParsedFile, ...]]
    resolved: Outcome[Program]
    parsed_by: Parser = parse
    memo: Memo | None = None

    @property
    def program(self) -> Program:
        """The resolved program of all files; parts with errors are missing."""
        return self.resolved.value

    @cached_property
    def compiled(self) -> Outcome[SkillLibrary]:
        """The compiled library with all diagnostics, as from the compiler; by far the slowest property."""
        with gc_disabled():
            checked = Outcome(self.program, find_problems(self.files, self.resolved, self.memo))
            return lower_and_report(checked, _ordered(self.library), self.memo)

    @property
    def problems(self) -> tuple[Diagnostic, ...]:
        """All diagnostics, in order of their places."""
        return self.compiled.diagnostics

    def with_useful_fixes(self, problems: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
        """Return some of the problems, with the fixes after which there are fewer errors."""

        def check(texts: Sequence[Source]) -> tuple[Diagnostic, ...]:
            changed = replace(self.library, sources={each.path: each for each in texts})
            return analyse(changed, self.parsed_by, self.memo).problems

        return keep_useful_fixes(self.problems, _ordered(self.library), check, problems)

    @cached_property
    def texts(self) -> Mapping[str, str]:
        """The text of every file that was read, by path."""
        read = {unit.file.path: unit.text for unit in self.program.files}
        return {**{path: source.text for path, source in self.library.sources.items()}, **read}

    @cached_property
    def visible(self) -> Mapping[str, VisibleNames]:
        """The names visible in each file, by path."""
        return find_visible(self.program, self.library.vocabulary)

    @cached_property
    def index(self) -> Index:
        """The occurrences of all symbols."""
        return build_index(self.program, self.visible)

    @cached_property
    def types(self) -> Mapping[Span, Type]:
        """The type of every resolved value, by its place."""
        return {value.span: value.type for value in self.program.values}

    def edition(self, path: str) -> int:
        """Return the edition that a file is written in."""
        return self.library.sources[path].edition if path in self.library.sources else NEWEST

    def words_as_names(self, path: str) -> frozenset[tuple[int, int]]:
        """Return the lines and columns, from 1, of words that are names in a file: they came after its edition."""
        later = list_later_words(self.edition(path))
        if not later:
            return frozenset()
        tokens = tokenize(self.library.sources[path]).value
        tokens = tuple(each for each in tokens if each.type == WORD and each.value in later)
        return frozenset((each.line or 0, each.column or 0) for each in tokens)

    def line(self, path: str, number: int) -> str:
        """Return a line of a file, counted from 1, or an empty string if it does not exist."""
        lines = self.texts.get(path, "").split("\n")
        return lines[number - 1] if 0 < number <= len(lines) else ""

    def text_of(self, span: Span) -> str:
        """Return the text at a place, with its lines joined by spaces."""
        lines = [self.line(span.path, number) for number in range(span.line, span.end_line + 1)]
        lines[-1] = lines[-1][: span.end_column - 1]
        lines[0] = lines[0][span.column - 1 :]
        return " ".join(line.strip() for line in lines)


def analyse(library: AnalysisInput, parsed_by: Parser = parse, memo: Memo | None = None) -> Analysis:
    """Parse and resolve a library; `parsed_by` is the parser, which may cache its results.

    `memo` has the analysis before, of which everything is reused that has not changed.
    """
    with gc_disabled():
        files = read_sources(_ordered(library), library.importable, library.name, parsed_by, library.namespaces)
        others = library.importable
        program = resolve_program(files.value, library.vocabulary, library.name, library.scenes, memo, others)
    return Analysis(library, files, program, parsed_by, memo)


def _ordered(library: AnalysisInput) -> tuple[Source, ...]:
    return tuple(library.sources[path] for path in sorted(library.sources))
