"""What can be wrong with a scene.

A scene is a Turtle file of individuals. `skillc check --scene` looks at it as a task loads it.

## not-turtle: a file is in another format

Scenes and vocabularies are Turtle.

Bad:

    <?xml version="1.0"?>

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation .

## unreadable-scene: a scene is no text in UTF-8, or cannot be opened

Save it as UTF-8 in the editor's settings, or with `iconv -f LATIN1 -t UTF-8`.

Bad:

    # this one is saved as Latin-1
    @prefix lab: <http://example.org/lab#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation ; rdfs:label "Küche" .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation ; rdfs:label "Küche" .

## empty-scene: a scene says of no individual what it is

Bad:

    # nothing yet

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation .

## unnamed-individual: an individual has no name

Plans, reports and authors call individuals by their names.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation ; skiros:contain [ a skiros:Product ] .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation ; skiros:contain lab:Box .
    lab:Box a skiros:Product .

## wrong-data-type: a value is not of the type that its property takes, or not within its bounds

A size is above 0, a friction at least 0, a threshold a share from 0 to 1: what the vocabulary says of the property.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Product ; skiros:Weight "1.5" .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Product ; skiros:Weight 1.5 .

## functional-property: a property that has one value only is given two

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Product ; skiros:Weight 1.5 , 2.5 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Product ; skiros:Weight 1.5 .

## functional-relation: a relation that has one value only is given two

The same for an inverse functional one: nothing is contained in two things.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation .
    lab:B a skillc:Workstation .
    lab:Box a skiros:Product ; skiros:at lab:A , lab:B .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation .
    lab:Box a skiros:Product ; skiros:at lab:A .

## irreflexive-relation: something is related to itself by a relation that never does that

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation ; skiros:contain lab:A .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation ; skiros:contain lab:Box .
    lab:Box a skiros:Product .

## asymmetric-relation: a relation that goes one way only goes both ways

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:A a skiros:Container ; skiros:contain lab:B .
    lab:B a skiros:Container ; skiros:contain lab:A .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:A a skiros:Container ; skiros:contain lab:B .
    lab:B a skiros:Container .

## disjoint-classes: an individual is of two classes that have nothing in common

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation , skiros:Product .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:A a skillc:Workstation .
"""
