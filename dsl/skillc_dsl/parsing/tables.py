"""The tables of the parser and the lexer: made with the package, or for a changed grammar once, and then cached."""

from __future__ import annotations

import functools
import hashlib
import re
import sys
from importlib import resources
from pathlib import Path

import msgspec

from skillc_dsl import cache
from skillc_dsl.units import UNITS

WORD = "NAME"
"""The terminal whose texts may be words of the language."""
BUILT = Path(__file__).with_name("tables.msgpack")
"""What the build of the package makes."""
_FORMAT = 1
"""Another number makes the tables in files unknown."""

NESTED = frozenset(
    (
        *("block", "counted", "timeout", "if_", "while_", "for_", "with_"),
        *("implies", "not_", "quantified", "parentheses"),
        *("sum", "product", "member", "apply", "list_of"),
    )
)
"""The names of rules that can be nested."""


class Rule(msgspec.Struct, frozen=True, array_like=True):
    """A rule of the grammar: what it makes of the last `size` values is a `origin`.

    `name` is what builders call it. The parts at `spread` are lists that it takes apart. With `replaces_one`, a single
    part stands for itself; with `is_list`, it only lists its parts, for the rule that it stands in.
    """

    origin: str
    name: str
    size: int
    spread: tuple[int, ...]
    replaces_one: bool
    is_list: bool
    is_nested: bool


class Tables(msgspec.Struct, frozen=True, array_like=True):
    """The tables of an LALR(1) parser, and of its lexer.

    `states` has for each symbol the state that follows, or `~n` if the rule `n` is complete; the parser begins in the
    state `start` and has a whole file in `end`. `pattern` has a named group for each terminal that the lexer tries;
    `fixed` has the texts of terminals that have but one, `words` the terminals of texts that are also names.
    """

    start: int
    end: int
    states: tuple[dict[str, int], ...]
    rules: tuple[Rule, ...]
    pattern: str
    fixed: dict[str, str]
    words: dict[str, str]
    ignored: frozenset[str]


def grammar_text() -> str:
    """Return the grammar with the terminal UNIT generated from the table of units, longest first."""
    units = "|".join(re.escape(unit).replace("/", r"\/") for unit in sorted(UNITS, key=lambda u: (-len(u), u)))
    return resources.files("skillc_dsl").joinpath("grammar.lark").read_text("utf-8") + f"UNIT: /({units})(?!\\w)/\n"


@functools.cache
def load_tables() -> Tables:
    """Return the tables of the language."""
    grammar = grammar_text()
    return read_built_tables(grammar, BUILT) or read_or_make_tables(grammar, cache.cache_folder())


@functools.cache
def load_pattern() -> re.Pattern[str]:
    """Return the pattern of the lexer."""
    return re.compile(load_tables().pattern)


def build_tables() -> None:
    """Make the tables and write them beside this file, where installations have them."""
    grammar = grammar_text()
    BUILT.write_bytes(_digest(grammar) + msgspec.msgpack.encode(_make(grammar)))


def read_built_tables(grammar: str, path: Path) -> Tables | None:
    """Return the tables that were built for `grammar`; None if there are none, or those of another grammar."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    size = len(_digest(""))
    return msgspec.msgpack.decode(content[size:], type=Tables) if content[:size] == _digest(grammar) else None


def _digest(grammar: str) -> bytes:
    return hashlib.sha256(f"{_FORMAT}\n{grammar}".encode()).digest()


def read_or_make_tables(grammar: str, folder: Path | None) -> Tables:
    """Return the tables of `grammar`, from the cache in `folder` if it is valid, else newly made and cached."""
    key = f"{_FORMAT} {sys.version_info[:2]}\n{grammar}"
    path = folder and folder / f"grammar-{hashlib.sha256(key.encode()).hexdigest()[:16]}"
    kept = cache.load(path) if path else None
    try:
        return msgspec.msgpack.decode(kept or b"", type=Tables)
    except msgspec.MsgspecError:
        tables = _make(grammar)
    if path:
        cache.store(path, msgspec.msgpack.encode(tables))
    return tables


def _make(grammar: str) -> Tables:
    # It takes as long as all else of a short command, and is needed once.
    from skillc_dsl.parsing.making import make_tables

    return make_tables(grammar)
