"""A deterministic Turtle writer: subjects, predicates and objects are sorted.

Blank nodes are always inline, as needed for OWL class expressions: `[ .. ]` and `( .. )`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import TypeAlias, assert_never

import msgspec

RDF_TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"
ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\r": "\\r", "\t": "\\t"}
LOCAL = re.compile(r"[A-Za-z_]([A-Za-z0-9_.-]*[A-Za-z0-9_-])?")


class IriNode(msgspec.Struct, frozen=True):
    """A named node."""

    iri: str


class AnonymousNode(msgspec.Struct, frozen=True):
    """`[ predicate object ; .. ]`, in the order given."""

    pairs: tuple[tuple[str, Object], ...]


class ListNode(msgspec.Struct, frozen=True):
    """`( item .. )`, in the order given."""

    items: tuple[Object, ...]


Object: TypeAlias = IriNode | AnonymousNode | ListNode | str | bool | int | float
Statements: TypeAlias = Iterable[tuple[str, str, Object]]


def format_turtle(prefixes: Mapping[str, str], statements: Statements) -> str:
    """Return the statements (subject IRI, predicate IRI, object) as a document, without duplicates."""
    bases = sorted(prefixes.items(), key=lambda item: (-len(item[1]), item[0]))
    subjects: dict[str, dict[str, set[str]]] = {}
    for subject, predicate, object_ in statements:
        subjects.setdefault(subject, {}).setdefault(predicate, set()).add(_object(object_, bases))
    head = "".join(f"@prefix {prefix}: <{base}> .\n" for prefix, base in sorted(prefixes.items()))
    return head + "".join(f"\n{_subject(each, subjects[each], bases)}" for each in sorted(subjects))


def _subject(subject: str, predicates: Mapping[str, set[str]], bases: list[tuple[str, str]]) -> str:
    ordered = sorted(predicates, key=lambda each: (each != RDF_TYPE, each))
    lines = [f"{_predicate(each, bases)} {_objects(predicates[each])}" for each in ordered]
    return f"{_iri(subject, bases)} " + " ;\n    ".join(lines) + " .\n"


def _objects(objects: set[str]) -> str:
    return ", ".join(objects) if len(objects) == 1 else ",\n        ".join(sorted(objects))


def _predicate(iri: str, bases: list[tuple[str, str]]) -> str:
    return "a" if iri == RDF_TYPE else _iri(iri, bases)


def _iri(iri: str, bases: list[tuple[str, str]]) -> str:
    for prefix, base in bases:
        if iri.startswith(base) and LOCAL.fullmatch(iri[len(base) :]):
            return f"{prefix}:{iri[len(base) :]}"
    return f"<{iri}>"


def _object(value: Object, bases: list[tuple[str, str]]) -> str:
    match value:
        case IriNode(iri=iri):
            return _iri(iri, bases)
        case AnonymousNode(pairs=pairs):
            inner = " ; ".join(f"{_predicate(predicate, bases)} {_object(each, bases)}" for predicate, each in pairs)
            return f"[ {inner} ]"
        case ListNode(items=items):
            return f"( {' '.join(_object(each, bases) for each in items)} )"
        case bool():
            return "true" if value else "false"
        case int():
            return str(value)
        case float():
            return f"{value!r}" if "e" in repr(value) else f"{value!r}e0"
        case str():
            return '"' + "".join(ESCAPES.get(each, each) for each in value) + '"'
        case _:
            assert_never(value)
