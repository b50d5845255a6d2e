"""Makes what editors and readers are told of the language from its descriptions: words and tables of the reference."""

from __future__ import annotations

import re
import runpy
from collections.abc import Iterable, Iterator, Sequence
from textwrap import fill

from msgspec.structs import astuple

from docs.pages import ROOT
from skillc_dsl.descriptions.constructs import first_word
from skillc_dsl.descriptions.members import FLAGS, MEMBERS, PARAMETERS
from skillc_dsl.descriptions.nodes import DECORATORS, NODES
from skillc_dsl.token_table import KEYWORDS, TYPES

STUDIO = ROOT / "studio/src/editor/keywords.ts"
VS_CODE = ROOT / "editors/vscode/syntaxes/skill.tmLanguage.json"
REFERENCE = ROOT / "docs/language.md"
TREES = ROOT / "docs/trees.md"


def make_studio_words() -> str:
    """Return the module of the studio's page with the keywords and types."""
    keywords = sorted({word for words in KEYWORDS.values() for word in words})
    return "\n\n".join(
        (
            "// The keywords and the types of the language; made by `python tests/accept.py`, not edited.",
            _list_words("KEYWORDS", keywords),
            _list_words("TYPES", sorted(TYPES)) + "\n",
        )
    )


def _list_words(name: str, words: Iterable[str]) -> str:
    listed = fill(" ".join(f'"{word}",' for word in words), 100, initial_indent="  ", subsequent_indent="  ")
    return f"// prettier-ignore\nexport const {name}: ReadonlySet<string> = new Set([\n{listed}\n]);"


def make_grammar() -> str:
    """Return the grammar of VS Code."""
    made: str = runpy.run_path(str(VS_CODE.parents[1] / "generate_grammar.py"))["grammar"]()
    return made


def make_reference() -> str:
    """Return the language reference with the rows of its tables of parameters, members and nodes."""
    flags = [(each.keyword, each.meaning) for each in FLAGS]
    text = REFERENCE.read_text("utf-8")
    for head, rows in (
        ("parameter | where the value comes from", [(first_word(each.written), each.meaning) for each in PARAMETERS]),
        ("member | meaning", [*((each.words[0].text, each.meaning) for each in MEMBERS), *flags]),
        ("node | meaning", [(each.written, each.meaning) for each in (*NODES, *DECORATORS)]),
    ):
        text = _replace_table(text, head, rows)
    return text


def make_trees() -> str:
    """Return the page on how trees run with the rows of its table of decorators."""
    rows = [(each.kind, *astuple(each.ticks)) for each in DECORATORS]
    return _replace_table(TREES.read_text("utf-8"), "decorator | start | tick | halts and releases | tried", rows)


def _replace_table(text: str, head: str, rows: Sequence[tuple[str, ...]]) -> str:
    table = re.compile(rf"^\| {re.escape(head)} \|\n(?:\|.*\n)+", re.M)
    made, count = table.subn(lambda _: "".join(_lines(head, rows)), text, count=1)
    assert count == 1, head
    return made


def _lines(head: str, rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    yield f"| {head} |\n|{'---|' * (1 + head.count('|'))}\n"
    yield from (f"| `{written}` | {' | '.join(cells)} |\n" for written, *cells in rows)
