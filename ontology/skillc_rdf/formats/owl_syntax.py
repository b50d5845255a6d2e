"""Reads the syntaxes of OWL that are not RDF: functional syntax, Manchester syntax and OWL/XML, as RDF/XML.

The mapping is W3C's "OWL 2 Web Ontology Language: Mapping to RDF Graphs"; py-horned-owl, of the extra `ontologies`,
does it. It is a parser without a limit of depth, so a text that is nested too deeply is refused before.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations
from typing import Any, Literal

import msgspec

from skillc_rdf.turtle.terms import OWL, RDF, RDFS, XSD

Serialization = Literal["ofn", "omn", "owx"]

STANDARD_PREFIXES = {"owl": OWL, "rdf": RDF, "rdfs": RDFS, "xsd": XSD}
"""The prefixes that OWL declares in each document."""
MOST_LITERALS = 10_000
"""The longest list of literals."""
_HEADS = {"ofn": "Prefix({}:=<{}>) ", "omn": "Prefix: {}: <{}> ", "owx": ""}
_DECLARED = re.compile(r"\bPrefix(?::\s*|\s*\(\s*)(\w*)\s*:")
_NESTING = re.compile(
    r"(?P<literal>\"(?:[^\"\\]|\\.)*+\")|<[^<>\s]*>|#[^\n]*|(?P<open>[({\[])|(?P<close>[)}\]])"
    r"|\b(?P<inner>some|only|min|max|exactly)\s|(?P<end>,|\b(?:and|or)\s|\w:\s)",
    re.DOTALL,
)
"""What nests expressions: brackets, and restrictions of Manchester syntax, which end where the next one begins."""
_PLACE = re.compile(r"Byte(?:Position|Span)\((\d+)")
_EXPECTED = re.compile(r"positives: \[([^\]]*)\]")
_SAID = re.compile(r'ValidityError\("([^"]*)"')


class OwlSyntax(msgspec.Struct, frozen=True):
    """A syntax of OWL, and how py-horned-owl calls it."""

    name: str
    serialization: Serialization


class NotOwlError(ValueError):
    """A text that is not in its syntax: why, and the offset in characters at which this is seen."""

    def __init__(self, reason: str, offset: int) -> None:
        super().__init__(reason)
        self.offset = offset


def find_too_much(text: str, syntax: OwlSyntax, deepest: int) -> int | None:
    """Return the offset of what the parser does not survive, None if nothing is.

    That are expressions nested more deeply than `deepest`, in what is no XML, and more than MOST_LITERALS in one list.
    """
    if syntax.serialization == "owx":
        lists = re.finditer(r"<DataOneOf>.*?</DataOneOf>", text, re.DOTALL)
        return next((each.start() for each in lists if each[0].count("<Literal") > MOST_LITERALS), None)
    brackets = restrictions = literals = 0
    for found in _NESTING.finditer(text):
        match found.lastgroup:
            case "open":
                brackets, literals = brackets + 1, 0
            case "close":
                brackets, literals = brackets - 1, 0
            case "inner":
                restrictions += 1
            case "end":
                restrictions = 0
            case "literal":
                literals += 1
        if brackets + restrictions > deepest or literals > MOST_LITERALS:
            return found.start()
    return None


def convert_to_xml(text: str, syntax: OwlSyntax) -> tuple[str, dict[str, str]]:
    """Return a text as RDF/XML, and its prefixes. NotOwlError; ModuleNotFoundError without the extra `ontologies`."""
    import pyhornedowl

    head = _missing_prefixes(text, syntax)
    try:
        ontology = pyhornedowl.open_ontology_from_string(head + text, syntax.serialization)
        _split_disjoint_classes(ontology)
        converted = ontology.save_to_string("rdf")
    except ValueError as error:
        raise _as_problem(str(error), text, len(head)) from error
    return converted, {str(name): str(iri) for name, iri in ontology.prefix_mapping}


def _missing_prefixes(text: str, syntax: OwlSyntax) -> str:
    declared = set(_DECLARED.findall(text))
    missing = ((name, iri) for name, iri in STANDARD_PREFIXES.items() if name not in declared)
    return "".join(_HEADS[syntax.serialization].format(*each) for each in missing)


def _split_disjoint_classes(ontology: Any) -> None:
    """Replace axioms about three or more disjoint classes by their pairs: only those of the first would be written."""
    from pyhornedowl.model import DisjointClasses

    for axiom in list(ontology.get_axioms()):
        component = axiom.component
        if isinstance(component, DisjointClasses) and len(component.first) > 2:
            ontology.remove_axiom(component)
            for pair in combinations(component.first, 2):
                ontology.add_axiom(DisjointClasses(list(pair)), axiom.ann)


def _as_problem(message: str, text: str, before: int) -> NotOwlError:
    """Return what the parser says as a problem of the text, which has followed as many characters as `before`."""
    place = _PLACE.search(message)
    offset = max(0, int(place[1]) - before) if place else 0
    return NotOwlError("".join(_reasons(message)), len(text.encode()[:offset].decode(errors="ignore")))


def _reasons(message: str) -> Iterator[str]:
    if expected := _EXPECTED.search(message):
        yield f"expected here: {' or '.join(_as_words(each) for each in expected[1].split(', '))}"
    elif said := _SAID.search(message):
        yield said[1][:1].lower() + said[1][1:]
    else:
        yield "it cannot be read"


def _as_words(rule: str) -> str:
    """Return the name of a rule of the grammar as words: "ClassExpression" as "class expression"."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", rule).lower() if not rule.isupper() else rule
