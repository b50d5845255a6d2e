"""Converts tokens to RDF terms: IRIs, prefixed names, texts without escapes, numbers."""

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
    """A token that is not a valid term; the message completes a sentence that begins with the token."""


def text_of(token: Token) -> str:
    """Return the text between quotes without escapes; TermError for an invalid escape."""
    width = 3 if token.text[:3] in ('"""', "'''") and len(token.text) >= 6 else 1
    inside = token.text[width:-width]
    return _ESCAPE.sub(_character, inside) if "\\" in inside else inside


def iri_of(token: Token, base: str) -> str:
    """Return the IRI between angle brackets, resolved against `base`; TermError if it is invalid."""
    return _resolve(_ESCAPE.sub(_code_point, token.text[1:-1]), base)


def local_of(token: Token) -> tuple[str, str]:
    """Return the prefix and the local name, without escapes, of a prefixed name."""
    prefix, _, local = token.text.partition(":")
    return prefix, _LOCAL_ESCAPE.sub(r"\1", local) if "\\" in local else local


def number_of(token: Token) -> ox.Literal:
    """Return a number as a literal with the datatype of its form."""
    if "e" in token.text or "E" in token.text:
        kind = "double"
    else:
        kind = "decimal" if "." in token.text else "integer"
    return ox.Literal(token.text, datatype=ox.NamedNode(XSD + kind))


@lru_cache(maxsize=4096)
def make_node(iri: str) -> ox.NamedNode:
    """Return the node of an absolute IRI; TermError if it is invalid."""
    try:
        return ox.NamedNode(iri)
    except ValueError as error:
        raise TermError(f"is not an IRI: {str(error).lower()}") from error


@lru_cache(maxsize=4096)
def _resolve(iri: str, base: str) -> str:
    """Return an IRI resolved against a base (RFC 3986), by the library that also validates IRIs."""
    try:
        (triple,) = ox.parse(f"<{iri}> <x:p> <x:o> .", format=ox.RdfFormat.TURTLE, base_iri=base or None)
    except (SyntaxError, ValueError) as error:
        reason = "it is relative, and there is no base" if "base" in str(error) else "it is not well formed"
        raise TermError(f"is not an IRI: {reason}") from error
    assert isinstance(triple.subject, ox.NamedNode)
    return triple.subject.value


def _character(match: re.Match[str]) -> str:
    if match.group(3) is None:
        return _code_point(match)
    if match.group(3) not in _CHARACTERS:
        raise TermError(f"has `\\{match.group(3)}`, which is not an escape; write a backslash as `\\\\`")
    return _CHARACTERS[match.group(3)]


def _code_point(match: re.Match[str]) -> str:
    if match.group(3) is not None:
        raise TermError(f"has `\\{match.group(3)}`, which is not an escape in an IRI")
    number = int(match.group(1) or match.group(2), 16)
    if number in _SURROGATES or number > 0x10FFFF:
        raise TermError(f"has `{match.group()}`, which is not a character")
    return chr(number)
