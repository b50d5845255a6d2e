"""The terms of the OWL output: namespaces and the frame shared by all libraries.

Terms in css: are of the Capability-Skill-Service ontology, https://github.com/CaSkade-Automation/CSS, version 3.0.0:
a description is a capability restricted by constraints. An implementation corresponds to a skill of CSS, which has no
constraints. It is not declared as one, since reasoners lose a defined class that is also the object of a relation.
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.emit.owl.turtle import RDF_TYPE, IriNode, Object

OWL = "http://www.w3.org/2002/07/owl#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
XSD = "http://www.w3.org/2001/XMLSchema#"
CSS = "http://www.w3id.org/hsu-aut/css#"
SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
SKILLC = "https://w3id.org/skillc/core#"
PREFIXES = {"owl": OWL, "rdfs": RDFS, "xsd": XSD, "css": CSS, "skiros": SKIROS, "skillc": SKILLC}

DATATYPES = {"Bool": f"{XSD}boolean", "Int": f"{XSD}integer", **dict.fromkeys(("Text", "Message"), f"{XSD}string")}

INVOCATION = f"{SKILLC}Invocation"
INVOKES = f"{SKILLC}invokes"
ARGUMENT = f"{SKILLC}argument"
CAPABILITY = f"{CSS}Capability"
DIMENSION = f"{SKILLC}Dimension"

CLASSES = (
    INVOCATION,
    CAPABILITY,
    DIMENSION,
    *(f"{CSS}{name}" for name in ("Constraint", "SkillParameter", "InputParameter", "OutputParameter")),
    *(f"{SKIROS}{name}" for name in ("Skill", "Parameter", "Condition", "PreCondition", "PostCondition")),
    f"{SKILLC}HoldCondition",
    f"{SKILLC}OutcomeCondition",
    f"{SKILLC}PossibleCondition",
)
SUBCLASSES = (
    (f"{CSS}InputParameter", f"{CSS}SkillParameter"),
    (f"{CSS}OutputParameter", f"{CSS}SkillParameter"),
    (f"{SKIROS}PreCondition", f"{SKIROS}Condition"),
    (f"{SKIROS}PostCondition", f"{SKIROS}Condition"),
    (f"{SKILLC}HoldCondition", f"{SKIROS}Condition"),
    (f"{SKILLC}OutcomeCondition", f"{SKIROS}Condition"),
    (f"{SKILLC}PossibleCondition", f"{SKIROS}Condition"),
)
RELATIONS = (
    *(f"{SKIROS}{name}" for name in ("hasParam", "hasPreCondition", "hasPostCondition", "hasHoldCondition")),
    *(f"{SKILLC}{name}" for name in ("subject", "object", "hasOutcomeCondition", "hasPossibleCondition")),
    INVOKES,
    ARGUMENT,
    f"{CSS}isRestrictedBy",
)
PROPERTIES = tuple(f"{SKILLC}{name}" for name in ("desiredState", "operator", "conditionText"))
_NOTES = """
    comparedValue conditionProperty conditionRelation cost definedAt defaultValue definition dimension direction
    duration durationUnit greatestValue implements isList keep keepUnit leastValue likelihood parameterType pause
    preference python rank sensed senses sha256 unit
"""
ANNOTATIONS = tuple(f"{SKILLC}{name}" for name in _NOTES.split())


def declare_frame() -> Iterator[tuple[str, str, Object]]:
    """Yield the declarations of all terms above."""
    for iris, kind in (
        (CLASSES, "Class"),
        (RELATIONS, "ObjectProperty"),
        (PROPERTIES, "DatatypeProperty"),
        (ANNOTATIONS, "AnnotationProperty"),
    ):
        yield from ((iri, RDF_TYPE, IriNode(f"{OWL}{kind}")) for iri in iris)
    yield from ((lower, f"{RDFS}subClassOf", IriNode(upper)) for lower, upper in SUBCLASSES)
