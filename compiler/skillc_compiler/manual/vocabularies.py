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

Known are `xsd:double`, `integer`, `string`, `boolean`, `skillc:Pose`, `skillc:Vector`, `skillc:Direction` and an
`owl:oneOf` of texts.

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

## unknown-dimension: the dimension of a data property is none of the language

Numbers and vectors have a dimension by its name in the language: `Length`, `Force`. What else a property may have, a
whole number, a direction, a text, has none.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:draught a owl:DatatypeProperty ;
        rdfs:range skillc:Vector ;
        skillc:dimension "Velocity" .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:draught a owl:DatatypeProperty ;
        rdfs:range skillc:Vector ;
        skillc:dimension "Speed" .

## computed-relation: a computed relation has an axiom

A relation with `skillc:computedBy` holds where the named Python class says so, and nowhere else. Nothing is kept of it,
so nothing can follow from it: it has a domain and a range, and no axioms.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:isBeside a owl:ObjectProperty, owl:SymmetricProperty ;
        skillc:computedBy "lab.beside:Beside" .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:isBeside a owl:ObjectProperty ;
        skillc:computedBy "lab.beside:Beside" .

## unreadable-vocabulary: a file is in a format that is not read, or broken

Read are Turtle, N-Triples, RDF/XML, JSON-LD, TriG and N-Quads, told by what the file says first, not by its ending.
OWL/XML, Manchester and functional syntax are not read.

Bad:

    Prefix(lab:=<http://example.org/lab#>)
    Ontology(<http://example.org/lab>
        Declaration(Class(lab:Cup))
    )

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .

    lab:Cup a owl:Class .

## shipped-term: a file says more about a term that skillc declares itself

What skillc ships about its terms stands; copies of these ontologies are about under which nothing can be a scene. Terms
of your own may be above, below, equal to, disjoint with or inverse to shipped ones.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    skiros:Container rdfs:subClassOf lab:Bin, skiros:Product .
    lab:Bin a owl:Class .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    skiros:Container rdfs:subClassOf lab:Bin .
    lab:Bin a owl:Class .

## undeclared-term: a file uses a term that is declared nowhere

It is taken for what it is used as. Often the file that declares it is missing, or its name is misspelt.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:Mug a owl:Class ; rdfs:subClassOf lab:Cup .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:Cup a owl:Class .
    lab:Mug a owl:Class ; rdfs:subClassOf lab:Cup .

## missing-import: an ontology imports one that is not here

Nothing is fetched. If its terms are needed, put its file into the same folder.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    <http://example.org/lab> a owl:Ontology ; owl:imports <http://example.org/units> .
    lab:Cup a owl:Class .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    <http://example.org/lab> a owl:Ontology .
    lab:Cup a owl:Class .

## prefix-taken: an ontology wants the prefix of a shipped one

It gets the prefix that its file binds to its namespace, or the name of the file.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix vann: <http://purl.org/vocab/vann/> .

    <http://example.org/lab> a owl:Ontology ;
        vann:preferredNamespacePrefix "skiros" ;
        vann:preferredNamespaceUri "http://example.org/lab#" .
    lab:Cup a owl:Class .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix vann: <http://purl.org/vocab/vann/> .

    <http://example.org/lab> a owl:Ontology ;
        vann:preferredNamespacePrefix "lab" ;
        vann:preferredNamespaceUri "http://example.org/lab#" .
    lab:Cup a owl:Class .

## unused-axiom: a file says things that have no effect

They are counted by kind, once for each file. The reference lists what of OWL is used.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:lid a owl:ObjectProperty .
    lab:Cup a owl:Class ;
        rdfs:subClassOf [ a owl:Restriction ; owl:onProperty lab:lid ; owl:maxCardinality 1 ] .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:lid a owl:ObjectProperty, owl:FunctionalProperty ; rdfs:domain lab:Cup .
    lab:Cup a owl:Class .

## several-inverses: a relation has two inverses

By OWL the two are the same relation then.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:member a owl:ObjectProperty .
    lab:hasMember a owl:ObjectProperty ; owl:inverseOf lab:member .
    lab:isMemberOf a owl:ObjectProperty ; owl:inverseOf lab:member .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:member a owl:ObjectProperty .
    lab:isMemberOf a owl:ObjectProperty ; owl:inverseOf lab:member .

## several-domains: a relation has two domains at once

In OWL a subject would have to be both, which authors hardly ever mean; here it may be either.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:Cup a owl:Class .
    lab:Pot a owl:Class .
    lab:lid a owl:ObjectProperty ; rdfs:domain lab:Cup, lab:Pot .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:Cup a owl:Class .
    lab:Pot a owl:Class .
    lab:lid a owl:ObjectProperty ; rdfs:domain [ a owl:Class ; owl:unionOf ( lab:Cup lab:Pot ) ] .

## beyond-owl-dl: a transitive relation is functional, asymmetric or irreflexive too

The runtime understands it, reasoners for OWL 2 DL refuse the file.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:above a owl:ObjectProperty, owl:TransitiveProperty, owl:AsymmetricProperty .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .

    lab:above a owl:ObjectProperty, owl:TransitiveProperty .
    lab:on a owl:ObjectProperty, owl:AsymmetricProperty ; rdfs:subPropertyOf lab:above .
"""
