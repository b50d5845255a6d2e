"""Vocabularies in Turtle that cannot be read or used.

## broken-turtle: a file is not Turtle

Everything else in the file is ignored until it is mended.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .

    lab:Cup a owl:Class

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .

    lab:Cup a owl:Class .

## unknown-datatype: the range of a data property is no datatype of the language

Known are `xsd:double`, `integer`, `string`, `boolean`, `skillc:Pose`, `skillc:Vector` and an `owl:oneOf` of texts.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .

    lab:bought a owl:DatatypeProperty ;
        rdfs:range xsd:date .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .

    lab:age a owl:DatatypeProperty ;
        rdfs:range xsd:double .
"""
