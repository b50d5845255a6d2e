"""The parser of the grammar and queries on its tables, which are computed once and then cached."""

from __future__ import annotations

import functools
import hashlib
import io
import re
import sys
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path

import lark
from lark import Lark, Token
from lark.parsers.lalr_analysis import Shift
from lark.parsers.lalr_parser_state import ParseConf

from skillc_dsl import cache
from skillc_dsl.units import UNITS

END = "$END"
DECLARATIONS = frozenset({"CLASS", "RELATION", "PROPERTY", "FUNCTION", "SKILL", "IMPL", "TASK"})


def grammar_text() -> str:
    """Return the grammar with the terminal UNIT generated from the table of units, longest first."""
    units = "|".join(re.escape(unit).replace("/", r"\/") for unit in sorted(UNITS, key=lambda u: (-len(u), u)))
    return resources.files("skillc_dsl").joinpath("grammar.lark").read_text("utf-8") + f"UNIT: /({units})(?!\\w)/\n"


@functools.cache
def load_parser() -> Lark:
    """Return the parser of the language."""
    return make_parser(grammar_text(), cache.cache_folder())


@functools.cache
def fixed_texts() -> Mapping[str, str]:
    """Return the text of each terminal with a fixed text."""
    return {t.name: t.pattern.value for t in load_parser().terminals if t.pattern.type == "str"}


@functools.cache
def _tables() -> ParseConf[int]:
    tables: ParseConf[int] = load_parser().parse_interactive("").parser_state.parse_conf
    return tables


def shift(stack: Sequence[int], terminal: str) -> list[int] | None:
    """Return the stack of parser states after shifting `terminal`, or None if it does not fit."""
    tables, result = _tables(), list(stack)
    while True:
        action, target = tables.states[result[-1]].get(terminal, (None, None))
        if action is None:
            return None
        if action is Shift:
            return [*result, target]
        if target.expansion:
            del result[-len(target.expansion) :]
        result.append(tables.states[result[-1]][target.origin.name][1])
        if terminal == END and result[-1] == tables.end_state:
            return result


def can_continue(stack: Sequence[int], *terminals: str) -> bool:
    """Whether the parser accepts `terminals`, in this order, after the input that led to `stack`."""
    states: Sequence[int] | None = stack
    for terminal in terminals:
        states = None if states is None else shift(states, terminal)
    return states is not None


def list_fitting_terminals(stack: Sequence[int]) -> frozenset[str]:
    """Return all terminals that the parser accepts after the input that led to `stack`."""
    return frozenset(t for t in _tables().states[stack[-1]] if (t.isupper() or t == END) and shift(stack, t))


def list_following_terminals(terminals: str) -> frozenset[str]:
    """Return all terminals that fit after `terminals`, separated by spaces, at the start of a file."""
    stack = [_tables().start_state]
    for terminal in terminals.split():
        stack = shift(stack, terminal) or stack
    return list_fitting_terminals(stack)


def begins_line(tokens: Sequence[Token], index: int) -> bool:
    """Whether the token at `index` is the first on its line; true for the end of the file."""
    return index == 0 or tokens[index].type == END or tokens[index].line != tokens[index - 1].end_line


def make_parser(grammar: str, folder: Path | None) -> Lark:
    """Return the parser of `grammar`, from the cache in `folder` if it is valid, else newly built and cached."""
    if folder is None:
        return _make(grammar)
    key = f"{lark.__version__} {sys.version_info[:2]}\n{grammar}"
    path = folder / f"grammar-{hashlib.sha256(key.encode()).hexdigest()[:16]}"
    tables = cache.load(path)
    if tables is not None:
        return Lark.load(io.BytesIO(tables))
    parser = _make(grammar)
    content = io.BytesIO()
    parser.save(content)
    cache.store(path, content.getvalue())
    return parser


def _make(grammar: str) -> Lark:
    return Lark(grammar, parser="lalr", lexer="basic", keep_all_tokens=True, maybe_placeholders=False)
