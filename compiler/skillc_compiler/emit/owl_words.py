"""The words of the OWL output: namespaces and the frame every library stands in."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.emit.turtle import RDF_TYPE, Iri, Object
from skillc_compiler.library.skills import SkillLibrary

OWL = "http://www.w3.org/2002/07/owl#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
XSD = "http://www.w3.org/2001/XMLSchema#"
CSS = "http://www.w3id.org/hsu-aut/css#"
SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
SKILLC = "https://w3id.org/skillc/core#"
PREFIXES = {"owl": OWL, "rdfs": RDFS, "xsd": XSD, "css": CSS, "skiros": SKIROS, "skillc": SKILLC}

INVOCATION = f"{SKILLC}Invocation"
INVOKES = f"{SKILLC}invokes"
ARGUMENT = f"{SKILLC}argument"
CAPABILITY = f"{CSS}Capability"

CLASSES = (
    INVOCATION,
    CAPABILITY,
    *(f"{CSS}{name}" for name in ("Constraint", "InputParameter", "OutputParameter")),
    *(f"{SKIROS}{name}" for name in ("Skill", "Parameter", "Condition", "PreCondition", "PostCondition")),
    f"{SKILLC}HoldCondition",
)
SUBCLASSES = (
    (f"{SKIROS}PreCondition", f"{SKIROS}Condition"),
    (f"{SKIROS}PostCondition", f"{SKIROS}Condition"),
    (f"{SKILLC}HoldCondition", f"{SKIROS}Condition"),
)
RELATIONS = (
    *(f"{SKIROS}{name}" for name in ("hasParam", "hasPreCondition", "hasPostCondition", "hasHoldCondition")),
    *(f"{SKILLC}{name}" for name in ("subject", "object")),
    INVOKES,
    ARGUMENT,
    f"{CSS}isRestrictedBy",
)
PROPERTIES = tuple(f"{SKILLC}{name}" for name in ("desiredState", "operator", "conditionText"))
_NOTES = """
    comparedValue conditionProperty conditionRelation definedAt defaultValue direction duration greatestValue implements
    leastValue parameterType preference python rank sensed sha256
"""
ANNOTATIONS = tuple(f"{SKILLC}{name}" for name in _NOTES.split())


def library_base(library: SkillLibrary) -> str:
    """Return the namespace of the terms of a library."""
    return f"https://w3id.org/skillc/library/{library.name}#"


def frame() -> Iterator[tuple[str, str, Object]]:
    """Yield the declarations of every word above."""
    for iris, kind in (
        (CLASSES, "Class"),
        (RELATIONS, "ObjectProperty"),
        (PROPERTIES, "DatatypeProperty"),
        (ANNOTATIONS, "AnnotationProperty"),
    ):
        yield from ((iri, RDF_TYPE, Iri(f"{OWL}{kind}")) for iri in iris)
    yield from ((lower, f"{RDFS}subClassOf", Iri(upper)) for lower, upper in SUBCLASSES)
