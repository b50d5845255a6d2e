"""Turtle of all kinds: texts that are changed here and there, and texts made of all that RDF and OWL can say."""

from __future__ import annotations

from functools import cache
from random import Random

from skillc.services.library import libraries
from skillc_rdf.turtle.tokens import tokens

HEAD = """@prefix lab: <http://example.org/lab#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix dcterms: <http://purl.org/dc/terms/> .
"""
NAMES = tuple(f"lab:{name}" for name in "abcdefgh")
LITERALS = (
    *("3", "-0.0", "1e3", "1e999", "true", "false", '""', '"x"', '"x"@en', '"x"@en-GB-oed', "'''a\nb'''", '"\\u00e9"'),
    *('"3"^^xsd:integer', '"3"^^xsd:date', '"NaN"^^xsd:double', '"x"^^lab:own', '"1"^^xsd:boolean', '"\\uD800"', "+.5"),
    *('"[/b]"', '"Idle"', '"map"', "00012", "1.", '"x" @en', '"x"^^ xsd:string', '"\x00"', '"<b>"^^rdf:XMLLiteral'),
)
STATEMENTS = (
    "{a} owl:sameAs {b} .",
    "{a} owl:differentFrom {b} .",
    "[] a owl:AllDifferent ; owl:{members} ( {a} {b} {c} ) .",
    "lab:n a owl:NegativePropertyAssertion . lab:n owl:sourceIndividual {a} . "
    "lab:n owl:assertionProperty {r} ; owl:targetIndividual {b} .",
    "[] a owl:NegativePropertyAssertion ; owl:sourceIndividual {a} ; owl:assertionProperty {p} ; owl:targetValue {v} .",
    "[] a rdf:Statement ; rdf:subject {a} ; rdf:predicate {r} ; rdf:object {b} .",
    "<< {a} {r} {b} >> rdfs:comment {v} .",
    "{a} {r} {b} {{| rdfs:comment {v} |}} .",
    "{a} {{ {a} {r} {b} . }}",
    "{a} {r} ( {b} {c} ) .",
    "{a} {r} () .",
    "{a} {r} [ a {k} ] .",
    "{a} {r} [] , _:x .",
    "_:x {r} {a} . _:y {r} _:x . _:x {r} _:y .",
    "[ {r} {a} ] {p} {v} .",
    "( {a} ) {r} {b} .",
    "{a} rdf:_1 {b} ; rdf:value {v} ; rdfs:member {c} .",
    "lab:K a owl:Class ; rdfs:subClassOf {k} . {a} a lab:K .",
    "lab:K a owl:Class ; rdfs:subClassOf lab:L . lab:L a owl:Class ; rdfs:subClassOf lab:K .",
    "lab:K a owl:Class ; owl:equivalentClass {k} ; owl:oneOf ( {a} {b} ) ; owl:disjointWith {k} .",
    "lab:K a owl:Class ; rdfs:subClassOf [ a owl:Restriction ; owl:onProperty {r} ; owl:someValuesFrom {k} ] .",
    "lab:rel a owl:ObjectProperty ; rdfs:subPropertyOf {r} . {a} lab:rel {b} .",
    "{r} a owl:AsymmetricProperty , owl:IrreflexiveProperty .",
    "{k} {r} {a} ; rdfs:subClassOf {k} ; {p} {v} .",
    "{k} owl:disjointWith {k} .",
    "[] a owl:AllDisjointClasses ; owl:members ( {k} {k} ) .",
    "lab:note a owl:AnnotationProperty . {a} lab:note {v} ; lab:note [ {p} {v} ] .",
    "{a} a owl:NamedIndividual . lab:alone a owl:NamedIndividual .",
    "{a} a owl:Nothing .",
    "{a} a owl:Thing .",
    "<http://example.org/lab> a owl:Ontology ; owl:imports <http://example.org/other> ; owl:versionInfo {v} .",
    "@base <http://example.org/> . <rel> a {k} . <#x> {r} <../y> .",
    "@prefix lab: <http://example.org/other#> .",
    "BASE <http://x.org/> PREFIX z: <z#> z:a a {k} .",
    "{a} dcterms:creator [ rdfs:label {v} ] ; rdfs:seeAlso <x y> .",
    "{a} {r} {b} ; ; {p} {v} ; .",
    "{a} {r} {v} . {a} {p} {b} .",
    "{a} unknown:{r} {b} . {a} lab:unknown {v} . {a} <http://x.org/p> {v} .",
    "{a} a {v} , [] , ( {k} ) .",
    "{a} a {k} , {k} .",
)
"""What is rarely said, or wrong; names in braces are filled in."""


def generated(random: Random, statements: int) -> str:
    """Return a text of so many statements about a few individuals."""
    lines = [_prefixes(), *(f"{name} a {random.choice(_terms()[0])} ." for name in NAMES if random.random() < 0.9)]
    lines += (_statement(random) for _ in range(statements))
    if random.random() < 0.05:
        deep = random.randrange(1, 3000)
        opened, closed = random.choice((("[ rdfs:seeAlso ", "]"), ("( ", ")"), (f"[ {_terms()[1][0]} ", "]")))
        lines.append(f"lab:a rdfs:seeAlso {opened * deep}lab:b{closed * deep} .")
    return "\n".join(lines) + "\n"


def mutated(random: Random, text: str) -> str:
    """Return a text with a few tokens, lines, statements or characters changed."""
    for _ in range(random.choice((1, 1, 1, 2, 5))):
        text = random.choice((_token, _line, _sentence, _character, _insertion))(random, text)
    return text


def _statement(random: Random) -> str:
    classes, relations, properties = _terms()
    a, b, c = (random.choice(NAMES) for _ in range(3))
    k, r, p, v = (random.choice(each) for each in (classes, relations, properties, LITERALS))
    if random.random() < 0.5:
        return random.choice((f"{a} {r} {b} .", f"{a} {p} {v} .", f"{a} {r} {b} , {c} ; {p} {v} ."))
    members = random.choice(("members", "distinctMembers"))
    return random.choice(STATEMENTS).format(a=a, b=b, c=c, k=k, r=r, p=p, v=v, members=members)


@cache
def _terms() -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    """Return classes, relations and properties; those of which much is said in scenes more than once."""
    vocabulary = libraries.load_vocabulary()
    often = ("skiros:contain", "skiros:hasA", "skiros:at", "skiros:contain", "skillc:attachedTo")
    shorts = (sorted(map(vocabulary.short, each)) for each in (vocabulary.classes, vocabulary.properties))
    classes, properties = shorts
    classes = [*classes, *(["skiros:Location", "skiros:Product", "skillc:Workstation"] * 8)]
    return tuple(classes), (*sorted(map(vocabulary.short, vocabulary.relations)), *often * 3), tuple(properties)


def _prefixes() -> str:
    prefixes = libraries.load_vocabulary().prefixes.items()
    return HEAD + "".join(f"@prefix {name}: <{base}> .\n" for name, base in sorted(prefixes) if f"{name}:" not in HEAD)


def _token(random: Random, text: str) -> str:
    found = [each for each in tokens(text) if each.kind != "end"]
    if not found:
        return text
    one, other = random.choice(found), random.choice(found)
    new = random.choice(("", f"{one.text} {one.text}", other.text, _misspelt(random, one.text)))
    return text[: one.start] + new + text[one.end :]


def _misspelt(random: Random, word: str) -> str:
    at = random.randrange(len(word))
    return word[:at] + random.choice(("", word[at] * 2, word[at].swapcase())) + word[at + 1 :]


def _line(random: Random, text: str) -> str:
    return _exchanged(random, text.split("\n"), "\n")


def _sentence(random: Random, text: str) -> str:
    return _exchanged(random, text.split(" .\n"), " .\n")


def _exchanged(random: Random, parts: list[str], mark: str) -> str:
    one, other = random.randrange(len(parts)), random.randrange(len(parts))
    match random.randrange(3):
        case 0:
            del parts[one]
        case 1:
            parts.insert(one, parts[other])
        case _:
            parts[one], parts[other] = parts[other], parts[one]
    return mark.join(parts)


def _character(random: Random, text: str) -> str:
    at = random.randrange(len(text) + 1)
    new = random.choice(
        (*".;,[]()\"<>@^:_\\{}|#'", "\r", "\x00", "\t", "\ufeff", "\u2028", "é", "😀", "\ud800", "\x85")
    )
    return text[:at] + new + text[at + random.randrange(3) :]


def _insertion(random: Random, text: str) -> str:
    parts = text.split(" .\n")
    parts.insert(random.randrange(len(parts)) + 1, _statement(random).removesuffix(" ."))
    return " .\n".join(parts)
