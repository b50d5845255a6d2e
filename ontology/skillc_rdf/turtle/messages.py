"""What is said of a token that cannot stand where it does: in the author's words, with what to write."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from typing import NamedTuple

from skillc_rdf.turtle.tokens import Token

LONGEST = 40
COMMENTS = ("//", "/*", "--", ";;", "%")


class SyntaxMessage(NamedTuple):
    """What is wrong with a token, what to write instead, and the text that would be right in its place, if known."""

    message: str
    help: str = ""
    instead: str | None = None


def shown(token: Token) -> str:
    """Return a token as messages quote it: its first line, cut where it is long."""
    first = token.text.split("\n", 1)[0]
    return f"`{first if len(first) <= LONGEST else first[:LONGEST] + '..'}`" if first else "the end of the file"


def no_term(token: Token, names: Iterable[str]) -> SyntaxMessage | None:
    """Say why a token is no term at all, wherever it stands; `names` are those the text has. None for one that is."""
    match token.kind:
        case "open-text":
            return SyntaxMessage("the text that begins here has no closing quote", f"end it with `{_quote(token)}`")
        case "open-iri" if token.text.startswith("<<"):
            return SyntaxMessage(
                "statements about statements are not Turtle 1.1", "name what it is about, and say it of that"
            )
        case "open-iri":
            return SyntaxMessage("the IRI that begins here has no `>`", "an IRI has no spaces and ends with `>`")
        case "stray" if token.text.startswith(COMMENTS):
            return SyntaxMessage(f"{shown(token)} is no Turtle", "a comment begins with `#`")
        case "stray" if token.text.startswith(("{", "}")):
            return SyntaxMessage("named graphs are not Turtle", "a scene is one graph: remove the braces and the name")
        case "stray":
            return SyntaxMessage(f"{shown(token)} is no Turtle", "delete it, or put it in quotes if it is a text")
        case "word" if token.text not in ("a", "true", "false"):
            return _bare_word(token, names)
        case _:
            return None


def _bare_word(token: Token, names: Iterable[str]) -> SyntaxMessage:
    word = token.text
    near = get_close_matches(word.lower(), ("true", "false"), n=1, cutoff=0.7)
    if near:
        return SyntaxMessage(f"`{word}` is no value", f"did you mean `{near[0]}`?", near[0])
    same = sorted({name for name in names if name.partition(":")[2] == word})
    if same:
        instead = same[0] if len(same) == 1 else None
        return SyntaxMessage(
            f"`{word}` has no prefix", f"did you mean {' or '.join(f'`{s}`' for s in same[:3])}?", instead
        )
    return SyntaxMessage(f"`{word}` has no prefix", f'write `prefix:{word}`, or `"{word}"` if it is a text')


def no_subject(token: Token) -> SyntaxMessage:
    """Say why a token cannot begin a statement."""
    if token.is_mark(";,"):
        help_ = f"`{token.text}` goes on with a statement; did a `.` end it too early?"
        return SyntaxMessage(f"there is nothing that `{token.text}` could go on with", help_)
    if token.is_mark("."):
        return SyntaxMessage("there is no statement that this `.` could end", "delete it")
    return SyntaxMessage(f"a statement begins with the thing that it is about, and this is {shown(token)}")


def nothing_said(subject: Token) -> SyntaxMessage:
    """Say that a statement ends behind its subject."""
    return SyntaxMessage(f"nothing is said of {shown(subject)}", "say of which class it is, `a CLASS`, or delete it")


def no_declaration(word: str) -> SyntaxMessage:
    """Say that a prefix or a base is not declared like that."""
    form = "prefix name: <IRI>" if word == "prefix" else "base <IRI>"
    return SyntaxMessage(f"this is no declaration of a {word}", f"it is written `@{form} .`")


def new_statement(subject: Token) -> SyntaxMessage:
    """Say that a `;` stands before a new statement."""
    return SyntaxMessage(f"a `.` ends the statement, and {shown(subject)} begins another", "write `.`")


def no_predicate(token: Token) -> SyntaxMessage:
    """Say why a token cannot be what is said of a thing."""
    message = f"a relation or a property stands here, and this is {shown(token)}"
    return SyntaxMessage(message, "is there a `;` or `.` before it that should be a `,`, or is the relation missing?")


def no_object(token: Token, predicate: Token) -> SyntaxMessage:
    """Say why a predicate has no object."""
    if token.kind == "word":
        return SyntaxMessage(f"{shown(predicate)} has no value: `a` stands before a class")
    article = "it is" if predicate.text == "a" else "there is"
    help_ = f"write what {article} after {shown(predicate)}"
    if predicate.kind == "name":
        help_ += f", or `a {predicate.text}` if it is the class of the thing"
    return SyntaxMessage(f"{shown(predicate)} has no value", help_)


def goes_on() -> SyntaxMessage:
    """Say that a `.` ends a statement that goes on behind it."""
    return SyntaxMessage("this `.` ends the statement, and it goes on behind", "`;` says more of the same thing", ";")


def surplus(token: Token, before: Token) -> SyntaxMessage:
    """Say that a term stands where a mark should."""
    help_ = "a `;` stands before the next thing that is said"
    return SyntaxMessage(f"{shown(token)} stands behind {shown(before)}", help_, ";")


def missing_mark(mark: str, after: Token) -> SyntaxMessage:
    """Say that a mark is missing."""
    what = {".": "ends the statement", ";": "says more of the same thing", ",": "gives another value"}
    close = {"]": "ends what is in brackets", ")": "ends the list"}
    return SyntaxMessage(f"a `{mark}` is missing after {shown(after)}", f"`{mark}` {(what | close)[mark]}")


def number_with_unit(number: Token, unit: Token) -> SyntaxMessage:
    """Say that a number has no unit."""
    return SyntaxMessage(
        f"{shown(unit)} stands behind the number {number.text}", "numbers are in SI units and stand alone"
    )


def _quote(token: Token) -> str:
    return token.text[:3] if token.text[:3] in ('"""', "'''") else token.text[:1]
