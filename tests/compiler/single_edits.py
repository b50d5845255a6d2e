"""Mistakes of an author: one small edit at a random place of a text, the same for the same seed."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from skillc_dsl.parsing.grammar import END
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source
from skillc_dsl.units import UNITS

NAMES = ("NAME", "QNAME")
_ALIKE = (
    *(("in", "opt", "infer", "out"), ("pre", "hold", "post"), ("skill", "impl", "task"), ("seq", "sel")),
    *(("class", "relation", "property", "function"), ("and", "or"), ("exists", "forall"), ("uses", "shares")),
    *(("true", "false"), ("==", "!=", "<", "<=", ">", ">="), ("if", "while"), ("let", "refine")),
    *(("senses", "outcome"), ("expect", "start"), ("when", "where"), ("count", "sum"), ("min", "max", "mean")),
    *(("-=", "+=", ":="), ("retry", "repeat"), ("goal", "do"), ("test", "task"), ("enum", "class")),
)
"""Words that stand at the same places."""
_QUANTITY = re.compile(r"(-?[\d.]+)( ?)([A-Za-z/]+)")
_DECLARED = re.compile(r"^(?:enum|class|relation|property|function|skill|impl|task|test)\s+([\w:]+)", re.MULTILINE)
_BLOCK = re.compile(
    r"^(?:skill|task|impl \w+ of) (?P<skill>\w+).*?(?=^(?:##|skill |impl |task |class |relation |function )|\Z)",
    re.MULTILINE | re.DOTALL,
)
"""A skill, a task or an implementation, with the name of the skill that it is about."""
_PARAMETER = re.compile(r"^ +(?:in|opt|infer(?: any)?|out|let) +(\w+)", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Edit:
    """Replace the text between two offsets by another; `kind` is the kind of mistake."""

    start: int
    end: int
    new: str
    kind: str


def single_edit(text: str, seed: int) -> Edit:
    """Return the mistake for a seed."""
    chance = random.Random(seed)
    return chance.choice(_KINDS)(text, chance)


def independent_edits(text: str, seed: int, count: int) -> tuple[Edit, ...]:
    """Return so many mistakes in declarations that have nothing to do with each other, or fewer if there are fewer.

    What is said of a skill depends on its description, and on those of the skills that it calls. So none of the
    declarations describes, implements or names the skill of another, and none names two of these skills.
    """
    chance = random.Random(seed)
    blocks = list(_BLOCK.finditer(text))
    chosen: list[re.Match[str]] = []
    for block in chance.sample(blocks, len(blocks)):
        if len(chosen) < count and not any(_are_related(block, other, blocks) for other in chosen):
            chosen.append(block)
    return tuple(_within(text, *block.span(), chance) for block in sorted(chosen, key=lambda each: each.start()))


def apply_edits(text: str, edits: Sequence[Edit]) -> str:
    """Return the text with edits that do not overlap."""
    for edit in sorted(edits, key=lambda each: each.start, reverse=True):
        text = text[: edit.start] + edit.new + text[edit.end :]
    return text


def edited_lines(text: str, edit: Edit) -> range:
    """Return the lines of the text with this edit alone that it touches, counted from 1."""
    first = text.count("\n", 0, edit.start) + 1
    return range(first, first + max(text.count("\n", edit.start, edit.end), edit.new.count("\n")) + 1)


def describe(text: str, edit: Edit) -> str:
    """Return the edit in words."""
    return f"{edit.kind} {edited_lines(text, edit).start}: {text[edit.start : edit.end]!r} -> {edit.new!r}"


def misspell(word: str, chance: random.Random) -> str:
    """Return a word with a letter left out, doubled, exchanged with the next, or replaced."""
    at = chance.randrange(len(word))
    before, letter, after = word[:at], word[at], word[at + 1 :]
    forms = (
        before + after,
        before + 2 * letter + after,
        before + after[:1] + letter + after[1:],
        before + chance.choice("abcdefghij") + after,
    )
    return chance.choice(forms)


def _are_related(one: re.Match[str], other: re.Match[str], blocks: Sequence[re.Match[str]]) -> bool:
    if _names(one, other) or _names(other, one):
        return True
    return any(_names(each, one) and _names(each, other) for each in blocks)


def _names(block: re.Match[str], other: re.Match[str]) -> bool:
    """Whether a block names the skill of another one."""
    return bool(re.search(rf"\b{re.escape(other['skill'])}\b", block.group()))


def _within(text: str, start: int, end: int, chance: random.Random) -> Edit:
    edit = chance.choice(_KINDS)(text[start:end], chance)
    return Edit(edit.start + start, edit.end + start, edit.new, edit.kind)


def _tokens(text: str) -> list[Token]:
    return [token for token in tokenize(Source("", text)).value if token.type != END]


def _place(token: Token) -> tuple[int, int]:
    return token.start_pos or 0, token.end_pos or 0


def _delete(text: str, chance: random.Random) -> Edit:
    return Edit(*_place(chance.choice(_tokens(text))), "", "delete")


def _double(text: str, chance: random.Random) -> Edit:
    start, end = _place(chance.choice(_tokens(text)))
    return Edit(start, end, f"{text[start:end]} {text[start:end]}", "double")


def _swap(text: str, chance: random.Random) -> Edit:
    tokens = _tokens(text)
    index = chance.randrange(len(tokens) - 1)
    (start, end), (after, last) = map(_place, tokens[index : index + 2])
    return Edit(start, last, text[after:last] + text[end:after] + text[start:end], "swap")


def _misspell_token(text: str, chance: random.Random) -> Edit:
    start, end = _place(chance.choice(_tokens(text)))
    return Edit(start, end, misspell(text[start:end], chance), "misspell token")


def _misspell_name(text: str, chance: random.Random) -> Edit:
    names = [token for token in _tokens(text) if token.type in NAMES and len(token) > 2]
    start, end = _place(chance.choice(names))
    return Edit(start, end, misspell(text[start:end], chance), "misspell name")


def _misspell_declaration(text: str, chance: random.Random) -> Edit:
    places = [match.span(1) for form in (_DECLARED, _PARAMETER) for match in form.finditer(text)]
    if not places:
        return _misspell_name(text, chance)
    start, end = chance.choice(places)
    return Edit(start, end, misspell(text[start:end], chance), "misspell declaration")


def _exchange_name(text: str, chance: random.Random) -> Edit:
    names = [token for token in _tokens(text) if token.type in NAMES]
    start, end = _place(chance.choice(names))
    return Edit(start, end, str(chance.choice(names)), "exchange name")


def _exchange_keyword(text: str, chance: random.Random) -> Edit:
    places = [(token, group) for token in _tokens(text) for group in _ALIKE if token.value in group]
    if not places:
        return _misspell_name(text, chance)
    token, group = chance.choice(places)
    return Edit(*_place(token), chance.choice([word for word in group if word != token.value]), "exchange keyword")


def _delete_line(text: str, chance: random.Random) -> Edit:
    start, end = chance.choice(list(_lines(text)))
    return Edit(start, end, "", "delete line")


def _double_line(text: str, chance: random.Random) -> Edit:
    start, end = chance.choice(list(_lines(text)))
    return Edit(start, end, 2 * text[start:end], "double line")


def _cut_line(text: str, chance: random.Random) -> Edit:
    start, end = chance.choice([place for place in _lines(text) if len(text[slice(*place)].split()) > 1])
    words = [match.end() for match in re.finditer(r"\S+", text[start:end])]
    return Edit(start + chance.choice(words[:-1]), end - 1, "", "cut line")


def _wrong_unit(text: str, chance: random.Random) -> Edit:
    quantities = [match for match in _QUANTITY.finditer(text) if match[3] in UNITS]
    if not quantities:
        return _misspell_name(text, chance)
    match = chance.choice(quantities)
    unit = chance.choice(["", *sorted(UNITS)])
    return Edit(*match.span(), f"{match[1]} {unit}".strip(), "wrong unit")


def _lines(text: str) -> Iterator[tuple[int, int]]:
    """Yield the places of the lines that are neither empty nor comments, each with its line break."""
    for match in re.finditer(r"[^\n]*\n", text):
        if match.group().strip() and not match.group().lstrip().startswith("#"):
            yield match.span()


_KINDS: tuple[Callable[[str, random.Random], Edit], ...] = (
    _delete,
    _double,
    _swap,
    _misspell_token,
    _misspell_name,
    _misspell_declaration,
    _exchange_name,
    _exchange_keyword,
    _delete_line,
    _double_line,
    _cut_line,
    _wrong_unit,
)
