"""Slips of the pen: a token deleted, doubled, swapped with the next or misspelt."""

from __future__ import annotations

import random
from dataclasses import dataclass

from lark.exceptions import LarkError
from lark_peer import load_parser

from skillc_dsl.parsing.grammar import END
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.source import Source


@dataclass(frozen=True)
class Mutation:
    """A changed text, the lines that changed, and what was done."""

    text: str
    lines: frozenset[int]
    told: str


def mutation(text: str, seed: int) -> Mutation:
    """One slip in `text`, which has two tokens at least; the same for the same seed."""
    chance = random.Random(seed)
    tokens = [token for token in tokenize(Source("", text)).value if token.type != END]
    index = chance.randrange(len(tokens) - 1)
    token, following = tokens[index : index + 2]
    start, end, after, last = (
        place or 0 for place in (token.start_pos, token.end_pos, following.start_pos, following.end_pos)
    )
    line, next_line = token.line or 1, following.line or 1
    match chance.choice(["delete", "double", "swap", "misspell"]):
        case "delete":
            return Mutation(text[:start] + text[end:], frozenset({line}), f"{line}: deleted {token}")
        case "double":
            return Mutation(f"{text[:end]} {text[start:]}", frozenset({line}), f"{line}: doubled {token}")
        case "swap":
            swapped = text[:start] + text[after:last] + text[end:after] + text[start:end] + text[last:]
            return Mutation(swapped, frozenset({line, next_line}), f"{line}: swapped {token} and {following}")
        case _:
            wrong = misspelt(str(token), chance)
            return Mutation(text[:start] + wrong + text[end:], frozenset({line}), f"{line}: {token} became {wrong}")


def misspelt(word: str, chance: random.Random) -> str:
    """A word with a letter left out, doubled, exchanged with the next, or replaced."""
    at = chance.randrange(len(word))
    forms = (
        word[:at] + word[at + 1 :],
        word[:at] + word[at] + word[at:],
        word[:at] + word[at + 1 : at + 2] + word[at] + word[at + 2 :],
        word[:at] + chance.choice("abcdefghij") + word[at + 1 :],
    )
    return chance.choice(forms)


def is_grammatical(text: str) -> bool:
    """Whether the strict grammar takes the text, without any recovery."""
    try:
        load_parser().parse(text)
    except LarkError:
        return False
    return True
