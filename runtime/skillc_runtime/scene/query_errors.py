"""Messages for errors in the text of a query, with the position."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

FORMS = ("SELECT", "ASK", "CONSTRUCT", "DESCRIBE")
UPDATES = ("INSERT", "DELETE", "WITH", "LOAD", "CLEAR", "CREATE", "DROP", "COPY", "MOVE", "ADD")
OPENING, CLOSING = frozenset("({["), frozenset(")}]")
MOST_NESTED = 100
"""So many brackets may be inside each other: the parser needs stack for each, and a process without stack dies."""
MOST_NEGATED = 8
"""So many of them may follow a `!`: with each more the parser takes twice as long to see that a query is broken."""

_TOKEN = re.compile(
    r"""(?P<skip>\s+|\#[^\n]*|@[A-Za-z-]+)
      | (?P<text>\"{3}(?:[^"\\]|\\.|\"(?!\"\"))*\"{3}|'{3}(?:[^'\\]|\\.|'(?!''))*'{3}|\"{3}.*|'{3}.*
          |"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|["'][^\n]*)
      | (?P<iri><[^<>"{}|^`\\\s]*>)
      | (?P<variable>[?$]\w+)
      | (?P<name>(?:_|[^\W\d_][\w-]*+(?:\.+[\w-]++){0,16}+)?:[\w.:%\\-]*)
      | (?P<word>[^\W\d]\w*)
      | (?P<mark>.)""",
    re.VERBOSE | re.DOTALL,
)
_PLACE = re.compile(r"error at (\d+):(\d+): expected (?:one of )?")
_SENTENCE = re.compile(r"[A-Z][A-Za-z]* [A-Za-z].*")


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    start: int


def federation_error(query: str) -> str | None:
    """Return the message for a query that asks another server; None for other queries."""
    asking = (token for token in _tokens(query) if token.kind == "word" and token.text.upper().startswith("SERVICE"))
    first = next(asking, None)
    if first is None:
        return None
    return _message_at(query, first.start, "SERVICE asks another server, and queries do not use the network")


def nesting_error(query: str) -> str | None:
    """Return the message for a query with too many brackets inside each other; None for other queries."""
    opened: list[bool] = []
    negated = False
    for token in (each for each in _tokens(query) if each.kind == "mark"):
        if token.text in OPENING:
            opened.append(negated)
            if len(opened) > MOST_NESTED:
                return _message_at(query, token.start, f"more than {MOST_NESTED} brackets are open here")
            if sum(opened) > MOST_NEGATED:
                return _message_at(query, token.start, f"more than {MOST_NEGATED} brackets after a `!` are open here")
        elif token.text in CLOSING and opened:
            opened.pop()
        negated = token.text == "!"
    return None


def syntax_error_message(query: str, parser: str, prefixes: Iterable[str]) -> str:
    """Return the message for a text that is not SPARQL; `parser` is the parser's message, `prefixes` are known."""
    tokens = list(_tokens(query))
    body = list(_without_prologue(tokens))
    if not body or body[0].text.upper() not in FORMS:
        return _no_query(query, body[0] if body else None)
    known = {*prefixes, *_declared(tokens), "_"}
    for token in body:
        prefix = token.text.partition(":")[0]
        if token.kind == "name" and prefix not in known:
            listed = ", ".join(sorted(known - {"_"}))
            return _message_at(query, token.start, f"there is no prefix `{prefix}:`; there are {listed}")
    return _message_at(query, _offset(query, parser), f"this is not SPARQL: {_reason(query, parser)}")


def _no_query(query: str, first: _Token | None) -> str:
    start = first.start if first else len(query)
    if first and first.text.upper() in UPDATES:
        return _message_at(query, start, f"queries only: {first.text.upper()} would change data")
    return _message_at(query, start, f"this is not SPARQL: a query begins with {', '.join(FORMS[:-1])} or {FORMS[-1]}")


def _reason(query: str, parser: str) -> str:
    """Return the parser's own sentence if there is one, else whether the text ends or is invalid at the position."""
    sentences = filter(_SENTENCE.fullmatch, _PLACE.sub("", parser).split(", "))
    sentence = next(sentences, None)
    if sentence:
        return sentence if sentence[:2].isupper() else sentence[0].lower() + sentence[1:]
    if not query[_offset(query, parser) :].strip():
        return "the query is incomplete, or its last part is invalid"
    return "it is invalid from here on"


def _offset(query: str, parser: str) -> int:
    place = _PLACE.match(parser)
    if place is None:
        return 0
    line, column = int(place[1]), int(place[2])
    starts = [0, *(match.end() for match in re.finditer("\n", query))]
    return min(starts[min(line, len(starts)) - 1] + column - 1, len(query))


def _message_at(query: str, offset: int, sentence: str) -> str:
    """Return the sentence with line and column, from 1, and the line with a caret below it."""
    start = query.rfind("\n", 0, offset) + 1
    line = query[start:].partition("\n")[0]
    place = f"line {query.count(chr(10), 0, offset) + 1}, column {offset - start + 1}"
    indent = re.sub(r"[^\t]", " ", line[: offset - start])
    return f"{sentence} ({place})\n  {line}\n  {indent}^"


def _tokens(query: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(query):
        if match.lastgroup not in (None, "skip"):
            yield _Token(str(match.lastgroup), match.group(), match.start())


def _without_prologue(tokens: list[_Token]) -> Iterator[_Token]:
    """Yield the tokens after `PREFIX name: <iri>` and `BASE <iri>`."""
    at = 0
    while at < len(tokens) and tokens[at].text.upper() in ("PREFIX", "BASE"):
        at += 3 if tokens[at].text.upper() == "PREFIX" else 2
    yield from tokens[at:]


def _declared(tokens: list[_Token]) -> set[str]:
    return {name.text.removesuffix(":") for word, name in pairwise(tokens) if word.text.upper() == "PREFIX"}
