"""The edits of skill files with which a library means the same in the newest edition."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.symbols import (
    FunctionSymbol,
    ImplementationSymbol,
    Occurrence,
    ParameterSymbol,
    SkillSymbol,
    Symbol,
    TermSymbol,
)
from skillc_compiler.program.name_notes import find_later_names
from skillc_compiler.program.program import ParsedFile
from skillc_compiler.resolve.declaring.declarations import library_prefix, prefixes_in, used_vocabularies
from skillc_compiler.resolve.names import KINDS, Kind, bare_terms
from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span
from skillc_dsl.token_table import list_later_words
from skillc_rdf.vocabulary.types import local_name


def find_edition_edits(analysis: Analysis) -> tuple[Fix, ...]:
    """Return the edits of a library without errors in an older edition, in order of their places.

    Former names become the present ones; a skill or function that would be declared twice gets another name; terms
    whose bare names would mean others, or would be words, are written with a prefix.
    """
    own = [unit for unit in analysis.program.files if unit.file.path in analysis.library.sources]
    edits = [*_present_names(analysis, own), *_other_names(analysis, own), *_prefixed_terms(analysis, own)]
    return tuple(sorted(dict.fromkeys(edits), key=lambda each: each.span))


def _present_names(analysis: Analysis, own: Iterable[ParsedFile]) -> Iterator[Fix]:
    """Yield an edit for each former name of what is called otherwise now."""
    for each in _occurrences(analysis, own):
        match each.symbol:
            case SkillSymbol(name) | FunctionSymbol(name) | ImplementationSymbol(_, name) | ParameterSymbol(_, name):
                written = analysis.text_of(each.span)
                if written != name:
                    text = f"{name}: {written}" if each.shorthand else name
                    yield Fix(each.span, text, f"`{written}` is `{name}` now")
            case _:
                pass


def _other_names(analysis: Analysis, own: Iterable[ParsedFile]) -> Iterator[Fix]:
    """Yield the edits that rename the skills and functions of the library that others declare since."""
    paths = analysis.library.sources.keys()
    later = {name for unit in analysis.program.files if unit.file.path not in paths for name in find_later_names(unit)}
    for symbol in _declared(analysis, own, SkillSymbol | FunctionSymbol):
        assert isinstance(symbol, SkillSymbol | FunctionSymbol)
        for each in analysis.index.of(symbol) if symbol.name in later else ():
            if each.span.path in paths:
                new = f"{library_prefix(analysis.library.name, '', {})}_{symbol.name}"
                yield Fix(each.span, new, f"`{symbol.name}` is `{new}` now: the standard library has a `{symbol.name}`")


def _prefixed_terms(analysis: Analysis, own: Iterable[ParsedFile]) -> Iterator[Fix]:
    """Yield the edits that write a prefix before terms whose bare names mean something else in the newest edition."""
    for unit in own:
        taken, prefixes = _later_names(analysis, unit), prefixes_in(unit.file, analysis.library.vocabulary)
        mine = library_prefix(unit.library, unit.namespace, analysis.library.vocabulary.prefixes)
        needed: dict[str, str] = {}
        for each in _occurrences(analysis, [unit]):
            if not isinstance(each.symbol, TermSymbol) or ":" in analysis.text_of(each.span):
                continue
            iri, name = each.symbol.iri, local_name(each.symbol.iri)
            if name in taken[each.symbol.kind] and iri not in analysis.library.vocabulary.since:
                base = iri.removesuffix(name)
                prefix = next((known for known, there in prefixes.items() if there == base), mine)
                needed |= {prefix: base} if prefix not in prefixes else {}
                yield Fix(each.span, f"{prefix}:{name}", f"`{name}` is written `{prefix}:{name}`")
        yield from (_declare(unit, prefix, base) for prefix, base in needed.items())


def _later_names(analysis: Analysis, unit: ParsedFile) -> Mapping[Kind, Set[str]]:
    """Return the bare names that mean a later term in a file, or are later words where relations stand."""
    vocabulary = analysis.library.vocabulary
    later, bare = vocabulary.later_than(unit.edition), bare_terms(vocabulary, used_vocabularies(unit.file, vocabulary))
    own = bare_terms(vocabulary, used_vocabularies(unit.file, vocabulary), unit.edition)
    found: dict[Kind, Set[str]] = {
        kind: {name for name in (*bare[kind], *own[kind]) if not later.isdisjoint(bare[kind].get(name, ()))}
        for kind in KINDS
    }
    return {**found, "relation": found["relation"] | list_later_words(unit.edition)}


def _declare(unit: ParsedFile, prefix: str, base: str) -> Fix:
    """Return the edit that declares a prefix, below the other lines at the top."""
    line = 1 + max((each.span.end_line for each in unit.file.header), default=0)
    return Fix(
        Span(unit.file.path, line, 1, line, 1), f"prefix {prefix}: <{base}>\n", f"the prefix `{prefix}` is declared"
    )


def _declared(analysis: Analysis, own: Iterable[ParsedFile], kinds: object) -> Iterator[Symbol]:
    found = (each.symbol for each in _occurrences(analysis, own) if each.declares)
    return iter(dict.fromkeys(each for each in found if isinstance(each, kinds)))  # type: ignore[arg-type]


def _occurrences(analysis: Analysis, units: Iterable[ParsedFile]) -> Iterator[Occurrence]:
    for unit in units:
        yield from analysis.index.by_path[unit.file.path]
