"""Parses a text without mistakes in one pass."""

from __future__ import annotations

from skillc_dsl import syntax as s
from skillc_dsl.parsing.automaton import MisfitError, Parser
from skillc_dsl.parsing.building.declarations import FileBuilder
from skillc_dsl.parsing.nesting import DEEPEST
from skillc_dsl.parsing.reserved_names import has_reserved_name
from skillc_dsl.parsing.token_repairs import has_unknown_unit
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source


def build_directly(tokens: tuple[Token, ...], source: Source) -> s.File | None:
    """Return the syntax tree of a text; None if there is anything to report. The last of its tokens is the end."""
    if has_unknown_unit(tokens) or has_reserved_name(tokens):
        return None
    builder = FileBuilder(source)
    parser = Parser(builder.make)
    try:
        for token in tokens[:-1]:
            parser.feed(token)
        file = parser.finish(tokens[-1])
    except MisfitError:
        return None
    is_clean = not builder.problems and parser.depths[-1] <= DEEPEST
    return file if is_clean and isinstance(file, s.File) else None
