"""The tables of the parser and the lexer: made with the package, or for a changed grammar once, and then cached."""

from __future__ import annotations

import functools
import hashlib
import re
import sys
from collections.abc import Iterator
from importlib import resources
from pathlib import Path

import msgspec

from skillc_dsl import cache
from skillc_dsl.descriptions.constructs import all_words, terminal
from skillc_dsl.descriptions.members import FLAGS
from skillc_dsl.descriptions.nodes import DECORATORS
from skillc_dsl.parsing.table_types import Tables
from skillc_dsl.units import UNITS


def grammar_text() -> str:
    """Return the grammar as lark reads it."""
    written = resources.files("skillc_dsl").joinpath("grammar.lark").read_text("utf-8")
    return "\n".join((written, *_made(), ""))


def _made() -> Iterator[str]:
    """Yield the rules and terminals that are not in the file."""
    yield f"flag: {' | '.join(terminal(each.keyword) for each in FLAGS)}"
    forms = ([terminal(each.kind), *("_sum" for _ in each.slots), "_nodes"] for each in DECORATORS)
    yield f"decorator: {' | '.join(map(' '.join, forms))}"
    for place in ("anywhere", "leading", "trailing"):
        yield f"_{place}: {' | '.join(terminal(word.text) for word in all_words() if word.name == place)}"
    yield from (f'{terminal(word.text)}: "{word.text}"' for word in all_words())
    units = "|".join(re.escape(unit).replace("/", r"\/") for unit in sorted(UNITS, key=lambda u: (-len(u), u)))
    yield f"UNIT: /({units})(?!\\w)/"


BUILT = Path(__file__).with_name("tables.msgpack")
"""What the build of the package makes."""
_FORMAT = 1
"""Another number makes the tables in files unknown."""


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
    """Make the tables and write them beside this file, where installations have them, whoever reads them meanwhile."""
    grammar = grammar_text()
    part = BUILT.with_suffix(".part")
    part.write_bytes(_digest(grammar) + msgspec.msgpack.encode(_make(grammar)))
    part.replace(BUILT)


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
