"""One misspelt name anywhere in a library that has no problem gives one error; `MISTAKES` sets how many are tried."""

import os
import random
import re
from collections.abc import Iterator, Sequence
from functools import cache

from shipped import library, shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

TRIED = int(os.environ.get("MISTAKES", "32"))
IMPORT = re.compile(r'^import "([^"]+)"', re.MULTILINE)
WORD = re.compile(r"[A-Za-z_]\w{2,}")
SKIPPED = re.compile(r'#[^\n]*|python "[^"]*"|<[^>]*>|(?<=scene )"[^"]*"')
WORDS_OF_THE_LANGUAGE = """
    all and any apply as check class deg disjoint duration else exists fallback false for forall function
    functional given goal has hold impl implies import infer inverse lead let max min Nm noplan not once opt out
    par post pre prefer prefix property python race rad range reactive refine relation repeat retry run scene
    scoped sel sensed seq shares skill sub symmetric task timeout transitive true try until use uses verify wait
    while with
"""
KEYWORDS = frozenset(WORDS_OF_THE_LANGUAGE.split())


@cache
def sources() -> tuple[Source, ...]:
    """Return the wiping library, and what is imported of the standard library, as one."""
    wiping = library("wiping")
    imported = {name for source in (*shelf().values(), *wiping) for name in IMPORT.findall(source.text)}
    standard = [Source(name, source.text) for name, source in shelf().items() if name in imported]
    return (*standard, *wiping)


def problems(changed: Sequence[Source]) -> tuple[Diagnostic, ...]:
    """Compile."""
    return compile(changed, vocabulary(), {}, "own").diagnostics


def words(source: Source) -> Iterator[re.Match[str]]:
    """Yield the names in a text: no keywords, and nothing that is in a comment or leads out of the library."""
    blank = SKIPPED.sub(lambda match: " " * len(match.group()), source.text)
    return (word for word in WORD.finditer(blank) if word.group() not in KEYWORDS)


def misspelt(word: str, chance: random.Random) -> str:
    """Return a word with a letter left out, doubled or moved."""
    place = chance.randrange(1, len(word) - 1)
    wrong = {
        0: word[:place] + word[place + 1 :],
        1: word[:place] + word[place] + word[place:],
        2: word[: place - 1] + word[place] + word[place - 1] + word[place + 1 :],
    }[chance.randrange(3)]
    return wrong if wrong != word and wrong not in KEYWORDS else word + "x"


def mistaken(seed: int) -> tuple[str, tuple[Diagnostic, ...]]:
    """Return a mistake, in words, and what the compiler says of it."""
    chance = random.Random(seed)
    index = chance.randrange(len(sources()))
    source = sources()[index]
    word = chance.choice(list(words(source)))
    wrong = misspelt(word.group(), chance)
    text = source.text[: word.start()] + wrong + source.text[word.end() :]
    line = source.text.count("\n", 0, word.start()) + 1
    changed = [*sources()[:index], Source(source.path, text), *sources()[index + 1 :]]
    return f"{seed} {source.path}:{line} {word.group()} -> {wrong}", problems(changed)


def test_the_library_has_no_problem() -> None:
    assert problems(sources()) == ()


def test_one_mistake_gives_one_error() -> None:
    tried = [mistaken(seed) for seed in range(TRIED)]
    seen = [(mistake, told) for mistake, told in tried if told]
    wrong = [(mistake, told) for mistake, told in seen if len(told) != 1]
    assert len(seen) > TRIED / 2
    shown = (f"{mistake}: {', '.join(f'{d.span} {d.name}' for d in told)}" for mistake, told in wrong)
    assert len(wrong) <= len(seen) * 0.05, "\n".join(shown)
