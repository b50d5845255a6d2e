"""Where a Turtle text makes each statement: RDF parsers keep no places, so its tokens are read a second time."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass

RDF_TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"

_TOKEN = re.compile(
    r"""(?P<skip>\s+|\#[^\n]*)
      | (?P<text>\"{3}(?:[^"\\]|\\.|\"(?!\"\"))*\"{3}|'{3}(?:[^'\\]|\\.|'(?!''))*'{3}
          |"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
      | (?P<iri><[^<>\s]*>)
      | (?P<tag>@[A-Za-z][\w-]*|\^\^)
      | (?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?<!\.))
      | (?P<name>(?:[\w-]|\.(?=[\w:%\\-]))*:(?:[\w:-]|%[0-9A-Fa-f]{2}|\\.|\.(?=[\w:%\\-]))*|[A-Za-z]\w*)
      | (?P<mark>[.;,\[\]()])
      | (?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement about a named subject: line and column, from 1, of its object; `object` is None unless an IRI."""

    subject: str
    predicate: str
    object: str | None
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    start: int


def statements(text: str, base: str = "") -> Iterator[Statement]:
    """Yield the statements of a valid Turtle text about named subjects, in order; `[ ]` and `( )` are passed over."""
    lines = _Lines(text)
    prefixes: dict[str, str] = {}
    sentence: list[_Token] = []
    for token in _tokens(text):
        if token.text == "." and token.kind == "mark":
            yield from _sentence(sentence, prefixes, base, lines)
            sentence = []
        elif sentence and sentence[0].text.upper() in ("PREFIX", "BASE") and token.kind == "iri":
            base = _declared([*sentence, token], prefixes, base)
            sentence = []
        else:
            sentence.append(token)
            if sentence[0].text in ("@prefix", "@base") and token.kind == "iri":
                base = _declared(sentence, prefixes, base)


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if match.lastgroup not in (None, "skip"):
            yield _Token(str(match.lastgroup), match.group(), match.start())


def _declared(sentence: list[_Token], prefixes: dict[str, str], base: str) -> str:
    iri = sentence[-1].text[1:-1]
    if sentence[0].text.strip("@").upper() == "BASE":
        return iri
    prefixes[sentence[1].text.removesuffix(":")] = iri
    return base


def _sentence(tokens: list[_Token], prefixes: dict[str, str], base: str, lines: _Lines) -> Iterator[Statement]:
    """Yield the statements of `subject predicate object, .. ; predicate object, .. .`"""
    if not tokens or tokens[0].kind not in ("iri", "name"):
        return
    subject = _iri(tokens[0], prefixes, base)
    predicate: str | None = None
    depth, expecting = 0, "predicate"
    for token in tokens[1:]:
        if token.text in ("[", "(") and token.kind == "mark":
            depth += 1
        elif token.text in ("]", ")") and token.kind == "mark":
            depth -= 1
        if depth or token.text in ("]", ")"):
            expecting = "mark"
        elif token.kind == "mark":
            expecting = "predicate" if token.text == ";" else "object"
        elif expecting == "predicate":
            predicate, expecting = _iri(token, prefixes, base), "object"
        elif expecting == "object" and predicate is not None:
            expecting = "mark"
            yield Statement(subject, predicate, _object(token, prefixes, base), *lines.place(token.start))


def _object(token: _Token, prefixes: dict[str, str], base: str) -> str | None:
    return (
        _iri(token, prefixes, base) if token.kind in ("iri", "name") and token.text not in ("true", "false") else None
    )


def _iri(token: _Token, prefixes: dict[str, str], base: str) -> str:
    if token.kind == "iri":
        iri = token.text[1:-1]
        return iri if ":" in iri else base + iri
    if token.text == "a":
        return RDF_TYPE
    prefix, _, local = token.text.partition(":")
    return prefixes.get(prefix, "") + re.sub(r"\\(.)", r"\1", local)


class _Lines:
    """Finds the line and column of an offset."""

    def __init__(self, text: str) -> None:
        self._starts = [0, *(match.end() for match in re.finditer("\n", text))]

    def place(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1
