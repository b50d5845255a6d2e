"""Texts in the skill language: those of the repository, changed at random, and noise."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from importlib.resources import files
from pathlib import Path
from random import Random

from fuzz.kinds._programs import write_program

TESTS = Path(__file__).parents[2]
MOST_LINES = (2, 3, 6, 24)
"""Longer texts are cut at a declaration, so that a case is quick."""

_TOKEN = re.compile(r"\"[^\"\n]*\"|[\w.-]+:?[\w-]*|[^\w\s]|\s+")
_ODD = [
    "\r",
    "\r\n",
    "\x0c",
    "\u2028",
    "\u0085",
    "\ufeff",
    "\x00",
    "\t",
    "\U0001f916",
    "é",
    "'",
    "`",
    "\\",
    "{{",
    "..",
    ":=",
]
_NESTED = ["do seq {", "par all {", "if a == b {", "(", "not ", "[", "retry 2 {", "exists x: Thing (", "- "]


@cache
def known_texts() -> tuple[str, ...]:
    """Return the texts of the repository: shipped libraries, test cases, the examples of the documentation."""
    folders = (Path(str(files("skillc_skills"))), TESTS)
    found = [
        path.read_text("utf-8", "surrogateescape") for folder in folders for path in sorted(folder.rglob("*.skill"))
    ]
    for page in sorted((TESTS.parent / "docs").glob("*.md")):
        found += re.findall(r"```skill\n(.*?)```", page.read_text("utf-8"), re.DOTALL)
    return tuple(found)


def make_text(random: Random) -> str:
    """Return a text that may be right, wrong or nonsense."""
    match random.randrange(10):
        case 0:
            return _noise(random)
        case 1 | 2 | 3:
            text = write_program(random)
        case _:
            text = _part(random.choice(known_texts()), random)
    for _ in range(random.choice([0, 1, 1, 1, 2, 3, 8])):
        text = change(text, random)
    return text


def change(text: str, random: Random) -> str:
    """Return the text with one change in it."""
    (make,) = random.choices(tuple(_CHANGES), tuple(_CHANGES.values()))
    return make(text, random)


def _part(text: str, random: Random) -> str:
    lines, most = text.split("\n"), random.choice(MOST_LINES)
    if len(lines) <= most:
        return text
    heads = [n for n, line in enumerate(lines) if line.startswith(("use ", "import ", "prefix "))]
    starts = [n for n, line in enumerate(lines) if re.match(r"(skill|impl|task|class|relation)\b", line)] or [0]
    first = random.choice(starts)
    return "\n".join([*(lines[n] for n in heads if n < first), *lines[first : first + most]])


def _tokens(text: str) -> list[str]:
    return _TOKEN.findall(text)


def _change_token(text: str, random: Random) -> str:
    tokens = _tokens(text) or [""]
    at = random.randrange(len(tokens))
    tokens[at] = random.choice(
        ["", tokens[at] * 2, random.choice(tokens), random.choice(_words()), _misspelt(tokens[at], random)]
    )
    return "".join(tokens)


def _swap_tokens(text: str, random: Random) -> str:
    tokens = _tokens(text) or [""]
    one, other = random.randrange(len(tokens)), random.randrange(len(tokens))
    tokens[one], tokens[other] = tokens[other], tokens[one]
    return "".join(tokens)


def _change_line(text: str, random: Random) -> str:
    lines = text.split("\n")
    at, to = random.randrange(len(lines)), random.randrange(len(lines))
    match random.randrange(4):
        case 0:
            del lines[at]
        case 1:
            lines.insert(to, lines[at])
        case 2:
            lines[at], lines[to] = lines[to], lines[at]
        case _:
            lines.insert(to, random.choice(random.choice(known_texts()).split("\n")))
    return "\n".join(lines)


def _change_character(text: str, random: Random) -> str:
    at = random.randrange(len(text) + 1)
    put = random.choice([*_ODD, chr(random.randrange(32, 127)), chr(random.randrange(0x3000))])
    return text[:at] + put + text[at + random.randrange(2) :]


def _cut(text: str, random: Random) -> str:
    at, to = sorted(random.randrange(len(text) + 1) for _ in range(2))
    return random.choice([text[:at], text[at:], text[:at] + text[to:], text[:to] + text[at:]])


def _nest(text: str, random: Random) -> str:
    at, depth = random.randrange(len(text) + 1), random.choice([2, 5, 30, 300, 3000])
    closing = random.choice(["", "}" * depth, ")" * depth])
    return f"{text[:at]} {random.choice(_NESTED) * depth} {closing} {text[at:]}"


def _repeat(text: str, random: Random) -> str:
    lines = text.split("\n")
    at = random.randrange(len(lines))
    return "\n".join([*lines[:at], *[lines[at]] * random.choice([2, 20, 200]), *lines[at:]])


def _line_ends(text: str, random: Random) -> str:
    return text.replace("\n", random.choice(["\r", "\r\n", "\n\n", " ", "\x0c\n"]), random.choice([1, 3, -1]))


_CHANGES: dict[Callable[[str, Random], str], int] = {
    _change_token: 30,
    _change_line: 15,
    _swap_tokens: 10,
    _change_character: 10,
    _cut: 5,
    _line_ends: 3,
    _repeat: 1,
    _nest: 1,
}
"""How often each change is made: large texts, which take long, seldom."""


def _misspelt(word: str, random: Random) -> str:
    at = random.randrange(len(word)) if word else 0
    return random.choice([word[:at] + word[at + 1 :], word[:at] + word[at : at + 1] + word[at:], word.swapcase()])


@cache
def _words() -> list[str]:
    """Return the tokens of all known texts, each once: keywords, names, quantities, marks."""
    return sorted({token for text in known_texts() for token in _tokens(text) if not token.isspace()})


def _noise(random: Random) -> str:
    length = random.choice([1, 10, 10, 30, 30, 100, 500])
    match random.randrange(3):
        case 0:
            return random.randbytes(length).decode("utf-8", "surrogateescape")
        case 1:
            return " ".join(random.choice(_words()) for _ in range(length))
        case _:
            return "".join(chr(random.randrange(0x500)) for _ in range(length))
