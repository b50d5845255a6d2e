"""Splits a Turtle text into tokens with their kinds and offsets; invalid text becomes tokens of own kinds.

Turtle 1.1, section 6.5: https://www.w3.org/TR/turtle/#sec-grammar
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import Literal, NamedTuple, TypeAlias, cast

Kind: TypeAlias = Literal[
    "iri", "name", "blank", "text", "number", "word", "at", "datatype", "mark", "open-text", "open-iri", "stray", "end"
]
"""`at` is a directive or a language tag, `open-text` and `open-iri` lack their end, `stray` is not Turtle."""

_ASCII = "A-Za-z"
_BEYOND = (
    "\u00c0-\u00d6\u00d8-\u00f6\u00f8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c\u200d\u2070-\u218f"
    "\u2c00-\u2fef\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
)
"""Letters beyond ASCII."""
_INSIDE = "\u00b7\u0300-\u036f\u203f\u2040"
"""What stands beyond ASCII in a name, but not at its beginning."""
_ESCAPED = r"%[0-9A-Fa-f]{2}|\\[_~.\-!$&'()*+,;=/?#@%]"
_MOST_DOTS = 16
"""The most dots in a prefix: a text without a `:` is not searched for one from each of its dots to its end."""
_ESCAPE = r"\\[^\r\n]"
_EXPONENT = r"[eE][+-]?[0-9]+"


def _write_expression(letter: str, inside: str) -> str:
    """Return the expression of a token, by the classes of its letters and of what else stands in a name."""
    start = f"{letter}_0-9"
    character = f"{start}{inside}\\-"
    prefix = rf"[{letter}][{character}]*+(?:\.+[{character}]++){{0,{_MOST_DOTS}}}+"
    local = rf"(?:[{start}:]|{_ESCAPED})(?:[{character}:]|{_ESCAPED}|\.+(?=[{character}:]|{_ESCAPED}))*"
    return rf"""(?P<skip>[ \t\r\n]+|\#[^\r\n]*)
      | (?P<name>(?:{prefix})?:(?:{local})?)
      | (?P<number>[+-]?(?:[0-9]+\.[0-9]*{_EXPONENT}|\.[0-9]+{_EXPONENT}|[0-9]+{_EXPONENT}|[0-9]*\.[0-9]+|[0-9]+))
      | (?P<mark>[.;,\[\]()])
      | (?P<text>\"\"\"(?:\"{{0,2}}(?:[^"\\]|\\.))*\"\"\"|'''(?:'{{0,2}}(?:[^'\\]|\\.))*'''
          |(?!\"\"\")"(?:[^"\\\r\n]|{_ESCAPE})*"|(?!''')'(?:[^'\\\r\n]|{_ESCAPE})*')
      | (?P<iri><[^<>"\x00-\x20]*>)
      | (?P<blank>_:[{start}](?:[{character}]|\.+(?=[{character}]))*)
      | (?P<at>@[A-Za-z]+(?:-[A-Za-z0-9]+)*)
      | (?P<datatype>\^\^)
      | (?P<word>[{letter}_][{character}]*)
      | (?P<open_text>(?:\"\"\"|''').*|["'][^\r\n]*)
      | (?P<open_iri><<|<[^\s<>"]*)
      | (?P<stray>[^\s"'<>;,\[\]()]+|.)"""


class Token(NamedTuple):
    """A token: its kind, its text, and the offsets where it begins and ends."""

    kind: Kind
    text: str
    start: int
    end: int

    def is_mark(self, marks: str) -> bool:
        """Whether this is one of the marks."""
        return self.kind == "mark" and self.text in marks

    def is_word(self, word: str) -> bool:
        """Whether this is the word."""
        return self.kind == "word" and self.text == word

    @property
    def is_unit(self) -> bool:
        """Whether this may be a unit after a number."""
        return self.kind in ("word", "stray") and self.text not in ("a", "true", "false")

    @property
    def begins_term(self) -> bool:
        """Whether a term, perhaps a wrong one, may begin here."""
        return self.is_mark("[(") or self.kind not in ("mark", "end", "at", "datatype")


@cache
def _expression(is_ascii: bool) -> re.Pattern[str]:
    """Return the compiled expression of a token: beyond ASCII, its classes of letters take long to compile."""
    written = _write_expression(_ASCII, "") if is_ascii else _write_expression(_ASCII + _BEYOND, _INSIDE)
    return re.compile(written, re.VERBOSE | re.DOTALL)


def tokens(text: str) -> Iterator[Token]:
    """Yield the tokens of a text, without white space and comments, and at the end one of the kind `end`."""
    for match in _expression(text.isascii()).finditer(text):
        kind = match.lastgroup
        if kind != "skip":
            yield Token(cast(Kind, (kind or "stray").replace("_", "-")), match.group(), match.start(), match.end())
    yield Token("end", "", len(text), len(text))
