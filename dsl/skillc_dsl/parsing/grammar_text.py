"""The grammar of the language: the written part, and what is made of the descriptions and of the units."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import resources

from skillc_dsl.descriptions.constructs import all_words, terminal
from skillc_dsl.descriptions.members import FLAGS
from skillc_dsl.descriptions.nodes import DECORATORS
from skillc_dsl.units import UNITS

_SLOTS = {"count": "number", "time": "_sum"}


def grammar_text() -> str:
    """Return the grammar as lark reads it."""
    written = resources.files("skillc_dsl").joinpath("grammar.lark").read_text("utf-8")
    return "\n".join((written, *_made(), ""))


def _made() -> Iterator[str]:
    """Yield the rules and terminals that are not in the file."""
    yield f"flag: {' | '.join(terminal(each.keyword) for each in FLAGS)}"
    forms = ([terminal(each.kind), *(_SLOTS[slot.kind] for slot in each.slots), "_nodes"] for each in DECORATORS)
    yield f"decorator: {' | '.join(map(' '.join, forms))}"
    for place in ("anywhere", "leading", "trailing"):
        yield f"_{place}: {' | '.join(terminal(word.text) for word in all_words() if word.name == place)}"
    yield from (f'{terminal(word.text)}: "{word.text}"' for word in all_words())
    units = "|".join(re.escape(unit).replace("/", r"\/") for unit in sorted(UNITS, key=lambda u: (-len(u), u)))
    yield f"UNIT: /({units})(?!\\w)/"
