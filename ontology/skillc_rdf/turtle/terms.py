"""Tokens of Turtle as RDF terms: IRIs with prefixes and base, texts without their escapes, numbers."""

from __future__ import annotations

import re
from functools import lru_cache

import pyoxigraph as ox

from skillc_rdf.turtle.tokens import Token

RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDF_TYPE = f"{RDF}type"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
OWL = "http://www.w3.org/2002/07/owl#"
XSD = "http://www.w3.org/2001/XMLSchema#"

_CHARACTERS = {"t": "\t", "b": "\b", "n": "\n", "r": "\r", "f": "\f", '"': '"', "'": "'", "\\": "\\"}
_ESCAPE = re.compile(r"\\(?:u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|(.))", re.DOTALL)
_LOCAL_ESCAPE = re.compile(r"\\(.)")
_SURROGATES = range(0xD800, 0xE000)


class TermError(ValueError):
    """A token that is no term; the message says why, in the middle of a sentence about it."""


def text_of(token: Token) -> str:
    """Return what a text in quotes says; TermError for an escape that there is none of."""
    width = 3 if token.text[:3] in ('"""', "'''") and len(token.text) >= 6 else 1
    inside = token.text[width:-width]
    return _ESCAPE.sub(_character, inside) if "\\" in inside else inside


def iri_of(token: Token, base: str) -> str:
    """Return the IRI between angle brackets, relative ones completed; TermError where it is none."""
    return _completed(_ESCAPE.sub(_code_point, token.text[1:-1]), base)


def local_of(token: Token) -> tuple[str, str]:
    """Return prefix and local name of a name, the latter without escapes."""
    prefix, _, local = token.text.partition(":")
    return prefix, _LOCAL_ESCAPE.sub(r"\1", local) if "\\" in local else local


def number_of(token: Token) -> ox.Literal:
    """Return a number with the datatype that its form says."""
    if "e" in token.text or "E" in token.text:
        kind = "double"
    else:
        kind = "decimal" if "." in token.text else "integer"
    return ox.Literal(token.text, datatype=ox.NamedNode(XSD + kind))


@lru_cache(maxsize=4096)
def named(iri: str) -> ox.NamedNode:
    """Return the node of an absolute IRI; TermError where it is none."""
    try:
        return ox.NamedNode(iri)
    except ValueError as error:
        raise TermError(f"is no IRI: {str(error).lower()}") from error


@lru_cache(maxsize=4096)
def _completed(iri: str, base: str) -> str:
    """Return an IRI against a base, as RFC 3986 has it: by the library that also knows which IRIs are well formed."""
    try:
        (triple,) = ox.parse(f"<{iri}> <x:p> <x:o> .", format=ox.RdfFormat.TURTLE, base_iri=base or None)
    except (SyntaxError, ValueError) as error:
        reason = "it is relative, and there is no base" if "base" in str(error) else "it is not well formed"
        raise TermError(f"is no IRI: {reason}") from error
    assert isinstance(triple.subject, ox.NamedNode)
    return triple.subject.value


def _character(match: re.Match[str]) -> str:
    if match.group(3) is None:
        return _code_point(match)
    if match.group(3) not in _CHARACTERS:
        raise TermError(f"has `\\{match.group(3)}`, which is no escape; a backslash is written `\\\\`")
    return _CHARACTERS[match.group(3)]


def _code_point(match: re.Match[str]) -> str:
    if match.group(3) is not None:
        raise TermError(f"has `\\{match.group(3)}`, which is no escape in an IRI")
    number = int(match.group(1) or match.group(2), 16)
    if number in _SURROGATES or number > 0x10FFFF:
        raise TermError(f"has `{match.group()}`, which is no character")
    return chr(number)
