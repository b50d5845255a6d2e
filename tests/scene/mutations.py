"""Scenes with one token deleted, doubled, exchanged or misspelt."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from skillc_rdf.turtle.tokens import Token, tokens

KINDS = ("delete", "double", "exchange", "misspell")


@dataclass(frozen=True, slots=True)
class Mutant:
    """A text after one mutation of a kind, on a line; `before` and `after` are the token."""

    kind: str
    text: str
    line: int
    before: str
    after: str


def mutants(text: str, seeds: range) -> Iterator[Mutant]:
    """Yield a mutant for each seed."""
    found = [token for token in tokens(text) if token.kind != "end"]
    for seed in seeds:
        yield _mutant(text, found, Random(seed))


def _mutant(text: str, found: list[Token], random: Random) -> Mutant:
    token, kind = random.choice(found), random.choice(KINDS)
    match kind:
        case "delete":
            new = ""
        case "double":
            new = f"{token.text} {token.text}"
        case "exchange":
            new = random.choice(found).text
        case _:
            new = _misspelt(token.text, random)
    line = text.count("\n", 0, token.start) + 1
    return Mutant(kind, text[: token.start] + new + text[token.end :], line, token.text, new)


def _misspelt(word: str, random: Random) -> str:
    """Return a word with a letter left out, doubled or exchanged with the next."""
    at = random.randrange(len(word))
    before, letter, after = word[:at], word[at], word[at + 1 :]
    return random.choice([before + after, before + 2 * letter + after, before + after[:1] + letter + after[1:]])
