"""Says how a relation that needs its prefix is written: the parser, which reports it, knows no vocabulary."""

from __future__ import annotations

from dataclasses import replace

from skillc_compiler.program.program import ParsedFile, Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.parsing.reserved import NAME
from skillc_rdf.vocabulary.types import local_name


def with_prefix(problem: Diagnostic, program: Program) -> Diagnostic:
    """Return the problem with the qualified name as its fix, if there is one relation of that name, else unchanged.

    The terms of a library have no prefix in a file that declares none; then the help says which line to add. Where the
    relation is declared, no prefix helps.
    """
    unit = next((unit for unit in program.files if unit.file.path == problem.span.path), None)
    if problem.name != NAME or unit is None or _names_declaration(problem, unit):
        return problem
    word = _text_at(unit, problem)
    found = [iri for iri in program.vocabulary.relations if local_name(iri) == word]
    if len(found) != 1:
        return problem
    base = found[0].removesuffix(word)
    prefix = _prefix_of(base, unit.file, program)
    if prefix:
        return replace(problem, help="", fix=Fix(problem.span, f"{prefix}:{word}", f"write `{prefix}:{word}`"))
    return replace(problem, help=f"add `prefix own: <{base}>` at the top of the file and write `own:{word}`")


def _names_declaration(problem: Diagnostic, unit: ParsedFile) -> bool:
    return any(each.name.span == problem.span for each in unit.file.declarations)


def _prefix_of(base: str, file: s.File, program: Program) -> str | None:
    """Return a prefix for a namespace that the file can use."""
    declared = {line.iri: line.name.text for line in file.header if isinstance(line, s.Prefix)}
    if base in {unit.namespace for unit in program.files}:
        return declared.get(base)
    return declared.get(base) or next((name for name, iri in program.vocabulary.prefixes.items() if iri == base), None)


def _text_at(unit: ParsedFile, problem: Diagnostic) -> str:
    line = unit.text.split("\n")[problem.span.line - 1]
    return line[problem.span.column - 1 : problem.span.end_column - 1]
