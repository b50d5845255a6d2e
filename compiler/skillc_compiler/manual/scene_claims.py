"""What a scene may say in OWL that contradicts it, or that has no effect.

## no-effect: a scene says something that changes nothing

Classes, relations and properties of individuals are facts; labels and other annotations are for people. Axioms,
lists, reification, languages of texts and imports are neither: they belong into an ontology, or have no meaning here.
Each kind of statement is told once, at its first place. The rest of the scene is used.

A class that the scene declares (`lab:Cup a owl:Class`, mostly with `rdfs:subClassOf`) is understood: the world has it,
and individuals may be of it. Relations and properties come from .skill files and ontologies alone.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container .
    skiros:contain a owl:ReflexiveProperty .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container .

## same-individuals: two individuals of a scene are said to be the same

Different names are different individuals, for conditions and for planners.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container ; owl:sameAs lab:Crate .
    lab:Crate a skiros:Container .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container .

## different-from-itself: an individual is said to be another than itself

`owl:differentFrom` and `owl:AllDifferent` are true of different names anyway.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container ; owl:differentFrom lab:Box .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container ; owl:differentFrom lab:Crate .
    lab:Crate a skiros:Container .

## denied-fact: a scene says that something is so, and that it is not

What a scene does not say is false already, so an `owl:NegativePropertyAssertion` adds nothing where it is right.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container ; skiros:contain lab:Cup .
    lab:Cup a skiros:Product .
    [] a owl:NegativePropertyAssertion ; owl:sourceIndividual lab:Box ;
        owl:assertionProperty skiros:contain ; owl:targetIndividual lab:Cup .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Box a skiros:Container ; skiros:contain lab:Cup .
    lab:Cup a skiros:Product .

## containment-circle: things hold each other in a circle

What contains or has something is not inside it, however many things are between them.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:A a skiros:Container ; skiros:contain lab:B .
    lab:B a skiros:Container ; skiros:contain lab:C .
    lab:C a skiros:Container ; skiros:contain lab:A .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:A a skiros:Container ; skiros:contain lab:B .
    lab:B a skiros:Container ; skiros:contain lab:C .
    lab:C a skiros:Container .
"""
