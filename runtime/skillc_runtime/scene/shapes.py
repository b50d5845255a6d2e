"""Exports a vocabulary as SHACL shapes, so that other tools can check scenes like skillc.

The shapes cover required properties, datatypes, enumerations and bounds, domains and ranges, numbers of values, and
disjoint classes. SHACL Core cannot express the other checks: asymmetric, irreflexive and transitive relations, misspelt
terms, frames, poses, and the length of directions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from skillc_rdf.vocabulary.types import (
    THING,
    Bounds,
    ClassTerm,
    DirectionType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    VectorType,
    Vocabulary,
)
from skillc_runtime.world.state.axioms import WorldAxioms

SHAPES = "https://w3id.org/skillc/shapes#"
PREFIXES = {"sh": "http://www.w3.org/ns/shacl#", "xsd": "http://www.w3.org/2001/XMLSchema#", "shape": SHAPES}
NUMBERS = ("double", "float", "decimal", "integer", "int", "nonNegativeInteger")
PLAIN = {"Text": ("string",), "Bool": ("boolean",), "Int": ("integer", "int", "nonNegativeInteger")}
NUMBER = r"[+-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+-]?\\d+)?"
VECTOR = rf"^\\s*{NUMBER}\\s+{NUMBER}\\s+{NUMBER}\\s*$"
"""The pattern of a vector, with doubled backslashes for Turtle."""


def format_shapes(vocabulary: Vocabulary) -> str:
    """Return the shapes as Turtle; the same vocabulary gives the same text."""
    return "\n".join((*_head(vocabulary.prefixes), *_Shapes(vocabulary).all())) + "\n"


def _head(prefixes: Mapping[str, str]) -> Iterator[str]:
    yield "# What scenes must be like, derived from the vocabulary by skillc."
    for prefix, base in sorted({**prefixes, **PREFIXES}.items()):
        yield f"@prefix {prefix}: <{base}> ."
    yield ""


class _Shapes:
    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._sources = WorldAxioms(vocabulary).sources

    def all(self) -> Iterator[str]:
        for _, cls in sorted(self._vocabulary.classes.items()):
            yield from self._of_class(cls)
        for _, term in sorted(self._vocabulary.properties.items()):
            if term.computed_by is None:
                yield from self._of_property(term)
        for _, relation in sorted(self._vocabulary.relations.items()):
            if relation.computed_by is None:
                yield from self._of_relation(relation)

    def _of_class(self, cls: ClassTerm) -> Iterator[str]:
        lines = [
            f"sh:property [ sh:path {self._path(iri)} ; sh:minCount 1 ]" for iri in cls.required if self._stored(iri)
        ]
        lines += (f"sh:not [ sh:class {self._name(other)} ]" for other in cls.disjoint)
        if lines:
            yield self._shape(cls.iri, [f"sh:targetClass {self._name(cls.iri)}", *lines])

    def _of_property(self, term: PropertyTerm) -> Iterator[str]:
        kinds = _datatypes(term)
        within = [f"sh:or ( {' '.join(f'[ sh:datatype xsd:{kind} ]' for kind in kinds)} )"] if kinds else []
        within += [f'sh:pattern "{VECTOR}"'] if isinstance(term.type, VectorType | DirectionType) else []
        within += ["sh:in ( " + " ".join(f'"{value}"' for value in term.values) + " )"] if term.values else []
        within += _ends(term.bounds) if term.bounds is not None else []
        within += ["sh:maxCount 1"] if term.functional else []
        of = [self._name(domain) for domain in term.domains if domain != THING]
        owner = [f"sh:or ( {' '.join(f'[ sh:class {each} ]' for each in of)} )"] if of else []
        lines = [*owner, f"sh:property [ sh:path {self._name(term.iri)} ; {' ; '.join(within)} ]"]
        yield self._shape(term.iri, [f"sh:targetSubjectsOf {self._name(term.iri)}", *lines])

    def _of_relation(self, term: RelationTerm) -> Iterator[str]:
        ends = [
            (f"sh:targetSubjectsOf {self._name(source)}", f"sh:targetObjectsOf {self._name(source)}")
            for source, _ in self._sources[term.iri]
        ]
        flipped = [turned for _, turned in self._sources[term.iri]]
        subjects = [pair[turned] for pair, turned in zip(ends, flipped, strict=True)]
        objects = [pair[not turned] for pair, turned in zip(ends, flipped, strict=True)]
        path = self._path(term.iri)
        if term.signatures:
            accepted = " ".join(self._signature(sig.domain, sig.range, path) for sig in term.signatures)
            yield self._shape(term.iri, [*subjects, f"sh:or ( {accepted} )"])
        if term.functional:
            yield self._shape(f"{term.iri}-one", [*subjects, f"sh:property [ sh:path {path} ; sh:maxCount 1 ]"])
        if term.inverse_functional:
            back = f"[ sh:inversePath {path} ]"
            yield self._shape(f"{term.iri}-of-one", [*objects, f"sh:property [ sh:path {back} ; sh:maxCount 1 ]"])

    def _signature(self, domain: str, range_: str, path: str) -> str:
        subject = f"sh:class {self._name(domain)} ; " if domain != THING else ""
        of_class = f" ; sh:class {self._name(range_)}" if range_ != THING else ""
        return f"[ {subject}sh:property [ sh:path {path} ; sh:nodeKind sh:IRI{of_class} ] ]"

    def _path(self, iri: str) -> str:
        """Return the property path to all values of a predicate, including sub-relations and inverses."""
        steps = [
            f"[ sh:inversePath {self._name(source)} ]" if turned else self._name(source)
            for source, turned in self._sources.get(iri, ((iri, False),))
        ]
        return steps[0] if len(steps) == 1 else f"[ sh:alternativePath ( {' '.join(steps)} ) ]"

    def _stored(self, iri: str) -> bool:
        term = self._vocabulary.properties.get(iri) or self._vocabulary.relations.get(iri)
        return term is None or term.computed_by is None

    def _shape(self, iri: str, lines: list[str]) -> str:
        name = self._vocabulary.short(iri).replace(":", "-")
        return f"shape:{name} a sh:NodeShape ;\n    " + " ;\n    ".join(lines) + " .\n"

    def _name(self, iri: str) -> str:
        return f"<{iri}>"


def _ends(bounds: Bounds) -> list[str]:
    ends = (
        ("minInclusive", bounds.least),
        ("minExclusive", bounds.above),
        ("maxInclusive", bounds.greatest),
        ("maxExclusive", bounds.below),
    )
    return [f"sh:{word} {end}" for word, end in ends if end is not None]


def _datatypes(term: PropertyTerm) -> tuple[str, ...]:
    match term.type:
        case NumberType():
            return NUMBERS
        case PlainType(name=name):
            return PLAIN.get(name, ())
        case _:
            return ()
