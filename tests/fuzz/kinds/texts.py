"""Texts through parser, formatter, checker, compiler and emitters."""

from __future__ import annotations

import json
import sys
from functools import cache
from importlib.resources import files
from pathlib import Path
from random import Random

from emit.reading_back import read_back_artifact
from fuzz.kinds._texts import make_text
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.pipeline import compile
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.encoding import decode
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.parsing import parser
from skillc_dsl.rendering import concise, full, github, sarif
from skillc_dsl.rendering import json as as_json
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary

NAME = "input.skill"
FORMATS = ("concise", "full", "github", "json", "sarif")


def run_case(random: Random, folder: Path) -> None:
    """Everything that the compiler does with a text ends in diagnostics or artifacts; what is formatted stays so."""
    data = make_text(random).encode("utf-8", "surrogateescape")
    (folder / NAME).write_bytes(data)
    try_text(decode(NAME, data), random.choice(FORMATS))


def try_text(source: Source, format: str) -> None:
    """Format and compile a text; emit what compiles; render what is wrong in a format."""
    _try_format(source)
    outcome = compile([source], vocabulary(), shelf(), "own", parsed_by=_parse)
    _try_rendering(source, outcome.diagnostics, format)
    if not any(problem.severity == "error" for problem in outcome.diagnostics):
        read_back_artifact(outcome.value, make_artifacts(outcome.value)["domain.pddl"])


def _try_format(source: Source) -> None:
    once = format_source(source)
    if not once.ok:
        assert once.value == source.text, "a file with errors was changed"
        assert once.diagnostics[0].name != "not-formatted", f"not formatted: {once.diagnostics[0].message}"
        return
    again = format_source(Source(source.path, once.value))
    assert again.ok and again.value == once.value, "formatting twice is not formatting once"


def _try_rendering(source: Source, problems: tuple[Diagnostic, ...], format: str) -> None:
    lines = source.text.split("\n")
    for problem in problems:
        span = problem.span
        assert span.path != NAME or (1 <= span.line <= len(lines) and span.column >= 1), f"out of the text: {problem}"
        assert problem.message, f"without a message: {problem}"
    sources = {source.path: source}
    match format:
        case "concise" | "github":
            shown = (concise if format == "concise" else github).render(problems, sources)
            assert len(shown.splitlines()) == len(problems), "not one line for each problem"
        case "full":
            full.render(problems, sources)
        case "json":
            json.loads(as_json.render(problems, sources))
        case "sarif":
            json.loads(sarif.render(problems, sources, {}, "0"))


@cache
def vocabulary() -> Vocabulary:
    """Return the shipped vocabulary."""
    return load([Source(path, text) for path, text in vocabulary_files()]).value


@cache
def shelf() -> dict[str, Source]:
    """Return the files that every library may import, by name."""
    root = Path(str(files("skillc_skills")))
    standard = {
        path.name: Source(f"std/{path.name}", path.read_text("utf-8"))
        for path in sorted((root / "std").glob("*.skill"))
    }
    others = {
        f"{folder}/{path.name}": Source(f"{folder}/{path.name}", path.read_text("utf-8"))
        for folder in ("wiping", "contact")
        for path in sorted((root / folder).glob("*.skill"))
    }
    return {**standard, **others}


@cache
def _parse_shipped(source: Source) -> Outcome[s.File]:
    return parser.parse(source)


def _parse(source: Source) -> Outcome[s.File]:
    return parser.parse(source) if source.path == NAME else _parse_shipped(source)


if __name__ == "__main__":
    for each in FORMATS:
        try_text(decode(NAME, Path(sys.argv[1]).read_bytes()), each)
