"""The messages of syntax errors: what is wrong with a token, and what to write instead."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import get_close_matches
from typing import NamedTuple

from skillc_rdf.turtle.tokens import Token

LONGEST = 40
COMMENTS = ("//", "/*", "--", ";;", "%")


class SyntaxMessage(NamedTuple):
    """The message about a token, a help text, and the text to write in its place, if known."""

    message: str
    help: str = ""
    instead: str | None = None


def quote_token(token: Token) -> str:
    """Return a token as messages quote it: its first line, at most LONGEST characters of it."""
    first = token.text.split("\n", 1)[0]
    return f"`{first if len(first) <= LONGEST else first[:LONGEST] + '..'}`" if first else "the end of the file"


def explain_invalid_term(token: Token, names: Iterable[str]) -> SyntaxMessage | None:
    """Return why a token is not a term, None if it is one; `names` are the prefixed names in the text."""
    match token.kind:
        case "open-text":
            return SyntaxMessage("the text that begins here has no closing quote", f"end it with `{_quote(token)}`")
        case "open-iri" if token.text.startswith("<<"):
            return SyntaxMessage(
                "Turtle 1.1 has no statements about statements", "make the statement about a named individual"
            )
        case "open-iri":
            return SyntaxMessage("the IRI that begins here has no `>`", "an IRI contains no spaces and ends with `>`")
        case "stray" if token.text.startswith(COMMENTS):
            return SyntaxMessage(f"{quote_token(token)} is not Turtle", "a comment begins with `#`")
        case "stray" if token.text.startswith(("{", "}")):
            return SyntaxMessage("named graphs are not Turtle", "a scene is one graph: remove the braces and the name")
        case "stray":
            return SyntaxMessage(
                f"{quote_token(token)} is not Turtle", "delete it, or put it in quotes if it is a text"
            )
        case "word" if token.text not in ("a", "true", "false"):
            return _bare_word(token, names)
        case _:
            return None


def _bare_word(token: Token, names: Iterable[str]) -> SyntaxMessage:
    word = token.text
    near = get_close_matches(word.lower(), ("true", "false"), n=1, cutoff=0.7)
    if near:
        return SyntaxMessage(f"`{word}` is not a value", f"did you mean `{near[0]}`?", near[0])
    same = sorted({name for name in names if name.partition(":")[2] == word})
    if same:
        instead = same[0] if len(same) == 1 else None
        return SyntaxMessage(
            f"`{word}` has no prefix", f"did you mean {' or '.join(f'`{s}`' for s in same[:3])}?", instead
        )
    return SyntaxMessage(f"`{word}` has no prefix", f'write `prefix:{word}`, or `"{word}"` if it is a text')


def explain_no_subject(token: Token) -> SyntaxMessage:
    """Return why a token cannot begin a statement."""
    if token.is_mark(";,"):
        help_ = f"`{token.text}` continues a statement; did a `.` end it too early?"
        return SyntaxMessage(f"there is no statement that `{token.text}` could continue", help_)
    if token.is_mark("."):
        return SyntaxMessage("this `.` ends no statement", "delete it")
    return SyntaxMessage(f"a statement begins with its subject, but this is {quote_token(token)}")


def explain_lone_subject(subject: Token) -> SyntaxMessage:
    """Return that a statement has only a subject."""
    return SyntaxMessage(f"nothing is stated about {quote_token(subject)}", "state its class, `a CLASS`, or delete it")


def explain_declaration(word: str) -> SyntaxMessage:
    """Return that a declaration of a prefix or a base is wrong."""
    form = "prefix name: <IRI>" if word == "prefix" else "base <IRI>"
    return SyntaxMessage(f"this is not a valid declaration of a {word}", f"write `@{form} .`")


def explain_new_statement(subject: Token) -> SyntaxMessage:
    """Return that a `;` is before a new statement."""
    return SyntaxMessage(f"{quote_token(subject)} begins a new statement, so a `.` must end this one", "write `.`")


def explain_no_predicate(token: Token) -> SyntaxMessage:
    """Return why a token cannot be a predicate."""
    message = f"a relation or a property is expected here, but this is {quote_token(token)}"
    return SyntaxMessage(message, "should the `;` or `.` before it be a `,`, or is the relation missing?")


def explain_no_object(token: Token, predicate: Token) -> SyntaxMessage:
    """Return why a predicate has no object."""
    if token.kind == "word":
        return SyntaxMessage(f"{quote_token(predicate)} has no value: `a` is written before a class")
    what = "the class" if predicate.text == "a" else "the value"
    help_ = f"write {what} after {quote_token(predicate)}"
    if predicate.kind == "name":
        help_ += f", or `a {predicate.text}` if it is a class"
    return SyntaxMessage(f"{quote_token(predicate)} has no value", help_)


def explain_early_end() -> SyntaxMessage:
    """Return that a `.` ends a statement that continues after it."""
    return SyntaxMessage("the statement continues after this `.`", "`;` separates predicates of the same subject", ";")


def explain_surplus(token: Token, before: Token) -> SyntaxMessage:
    """Return that a term is in the place of a mark."""
    help_ = "write a `;` before the next predicate"
    return SyntaxMessage(f"unexpected {quote_token(token)} after {quote_token(before)}", help_, ";")


def explain_missing_mark(mark: str, after: Token) -> SyntaxMessage:
    """Return that a mark is missing."""
    what = {".": "ends the statement", ";": "separates predicates of the same subject", ",": "separates values"}
    close = {"]": "closes the brackets", ")": "ends the list"}
    return SyntaxMessage(f"a `{mark}` is missing after {quote_token(after)}", f"`{mark}` {(what | close)[mark]}")


def explain_unit(number: Token, unit: Token) -> SyntaxMessage:
    """Return that a number must not have a unit."""
    return SyntaxMessage(
        f"unexpected {quote_token(unit)} after the number {number.text}",
        "numbers are in SI units, written without the unit",
    )


def _quote(token: Token) -> str:
    return token.text[:3] if token.text[:3] in ('"""', "'''") else token.text[:1]


_FORMATS = {
    "RDF/XML": re.compile(r"\s*<(?:\?xml|!DOCTYPE|!ENTITY|rdf:RDF|[\w-]+:[\w-]+[\s>])"),
    "JSON": re.compile(r'\s*(?:\{\s*["}]|\[\s*\{)'),
    "HTML": re.compile(r"\s*<(?:html|head|body)\b", re.IGNORECASE),
    "a skill library": re.compile(r"(?:\s|#[^\n]*\n)*(?:use\s+\w+\s*(?:,|\n)|(?:skill|task|import|impl)\s+[\"\w])"),
}
_CONVERTIBLE = ("RDF/XML", "JSON")


def detect_other_format(text: str) -> tuple[str, str] | None:
    """Return the name of the text's format and what to do about it; None if it may be Turtle."""
    for name, pattern in _FORMATS.items():
        if pattern.match(text):
            return name, "convert it to Turtle" if name in _CONVERTIBLE else "use a Turtle file"
    return None
