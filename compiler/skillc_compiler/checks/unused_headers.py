"""Lines at the top of a file that are never used."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from functools import cache, partial

from skillc_compiler.checks.unused import report_unused
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import ParsedFile, Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_rdf.vocabulary.types import Vocabulary, local_name

NAMES = ("unused-use", "unused-prefix", "unused-import")
NEEDS = Need.BODY
READS = Reads.NEIGHBOURS


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each line of a header that can be removed without changing anything."""
    terms = cache(partial(_terms, program.vocabulary))
    for unit in program.files:
        yield from _header(program, unit, terms)


def _header(program: Program, unit: ParsedFile, terms: Callable[[str], Collection[str]]) -> Iterator[Diagnostic]:
    """Yield a warning for each vocabulary, prefix and import of a header that is not used."""
    used = program.used[unit.file.path]
    prefixes = {text.partition(":")[0] for text in used if ":" in text}
    found = {line.path.span: path for line, path in unit.imports}
    for line in unit.file.header:
        match line:
            case s.Use():
                yield from _vocabularies(program, line, used, terms)
            case s.Prefix(name=name):
                if name.text not in prefixes:
                    yield report_unused("unused-prefix", name.span, f"the prefix `{name.text}` is never used")
            case s.Import(path=path):
                if path.span in found and not _import_used(program, unit, found[path.span]):
                    yield report_unused("unused-import", path.span, f'nothing of "{path.value}" is used here')


def _vocabularies(
    program: Program, line: s.Use, used: frozenset[str], terms: Callable[[str], Collection[str]]
) -> Iterator[Diagnostic]:
    for name in line.vocabularies:
        if name.text in program.vocabulary.prefixes and used.isdisjoint(terms(name.text)):
            yield report_unused("unused-use", name.span, f"nothing of `{name.text}` is used by its bare name here")


def _terms(vocabulary: Vocabulary, prefix: str) -> set[str]:
    base = vocabulary.prefixes[prefix]
    terms = (*vocabulary.classes, *vocabulary.relations, *vocabulary.properties, *vocabulary.aliases)
    return {local_name(iri) for iri in terms if iri.startswith(base)}


def _import_used(program: Program, unit: ParsedFile, path: str) -> bool:
    """Whether a file names a declaration of another, or has a goal, for which a planner may use all of them."""
    if any(isinstance(d, s.TaskDeclaration) and d.goal is not None for d in unit.file.declarations):
        return True
    imported = next(other for other in program.files if other.file.path == path)
    return any(d.name.text in program.used[unit.file.path] for d in imported.file.declarations)
