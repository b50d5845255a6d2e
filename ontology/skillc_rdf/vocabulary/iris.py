"""IRIs of the RDF, RDFS and OWL vocabularies."""

from __future__ import annotations

RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
OWL = "http://www.w3.org/2002/07/owl#"
XSD = "http://www.w3.org/2001/XMLSchema#"
VANN = "http://purl.org/vocab/vann/"
SKILLC = "https://w3id.org/skillc/core#"
EDITION, ADDS = f"{SKILLC}edition", f"{SKILLC}adds"
SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"

TYPE = f"{RDF}type"
CLASS, RELATION, PROPERTY = f"{OWL}Class", f"{OWL}ObjectProperty", f"{OWL}DatatypeProperty"
KINDS = (CLASS, RELATION, PROPERTY)
ANNOTATION, DATATYPE = f"{OWL}AnnotationProperty", f"{RDFS}Datatype"
SUBCLASS, SUBPROPERTY = f"{RDFS}subClassOf", f"{RDFS}subPropertyOf"
EQUAL_CLASS, EQUAL_PROPERTY = f"{OWL}equivalentClass", f"{OWL}equivalentProperty"
DISJOINT, COMPLEMENT, INVERSE = f"{OWL}disjointWith", f"{OWL}complementOf", f"{OWL}inverseOf"
DOMAIN, RANGE = f"{RDFS}domain", f"{RDFS}range"
BUILT_IN = (RDF, RDFS, OWL, XSD)
"""The namespaces of these vocabularies, whose terms ontologies do not declare."""
