"""Random graphs as Turtle in random layouts, and a text with everything that Turtle has."""

from __future__ import annotations

from collections import Counter
from random import Random

import pyoxigraph as ox
from rdflib import BNode, Graph, Literal, Namespace, URIRef
from rdflib.collection import Collection
from rdflib.namespace import RDF, XSD
from rdflib.term import Node

from skillc_rdf.turtle.tokens import tokens

BASE = "file:///scene"
SPACES = (" ", "\t", "\n", "\r\n", '  # a comment . ; "\n', "\n\n")
TEXTS = ("", "a", 'quoted " and \\ ', "two\nlines", "tab\t", "Umläute 🤖", "# no comment", "a . b ; c", "'''", '"""')
NAMES = ("x", "a", "b-1", "with.dot", "ü", "true", "per%20cent", "slash/es", "comma,", "é:colon")
EVERYTHING = """@prefix : <http://e/> . @prefix a.b: <http://f/> . PREFIX q: <g#> BASE <http://h/i/j>
:x a q:y, <../k?l#m>, _:n.o ; ; :p-q "a\\tb\\u00e9"@en-GB, 'c"d', \"\"\"e
"f" ""g\"\"\", '''h'i''' ^^ q:dt, -1, +2.5, .5e3, 1.e2, 1e-1, true, false .
[ :r [ :s ( 1 :t [] ( ) ) ] ] . [] a :z . ( 1 2 ) :u :v . :w:x a.b:c%20d\\,e :f.g . _:1 :p 1.5.
"""

Triples = Counter[tuple[str, str, str]]
"""Statements with blank nodes without their labels, by how often they are said."""


def random_text(seed: int) -> tuple[str, str]:
    """Return a random graph, as rdflib writes it, and with other white space and comments between the tokens."""
    random = Random(seed)
    text = _graph(random).serialize(format="turtle")
    parts = [token.text for token in tokens(text)]
    return text, "".join(part + random.choice(SPACES) for part in parts)


def by_oxigraph(text: str) -> Triples | None:
    """Return what another parser reads, None where it refuses the text."""
    try:
        triples = list(ox.parse(text, format=ox.RdfFormat.TURTLE, base_iri=BASE))
    except SyntaxError:
        return None
    return Counter((shown(t.subject), t.predicate.value, shown(t.object)) for t in triples)


def by_rdflib(text: str) -> set[tuple[str, str, str]]:
    """Return what yet another parser reads, by what terms are called in N-Triples."""
    graph = Graph().parse(data=text, format="turtle", publicID=BASE)
    return {(_n3(s), str(p), _n3(o)) for s, p, o in graph}


def shown(node: object) -> str:
    """Return a term as N-Triples have it, `_` for a blank node."""
    return "_" if isinstance(node, ox.BlankNode) else str(node)


def _n3(node: Node) -> str:
    if isinstance(node, BNode):
        return "_"
    if isinstance(node, Literal):
        return str(ox.Literal(str(node), datatype=_named(node.datatype), language=node.language))
    return str(ox.NamedNode(str(node)))


def _named(iri: URIRef | None) -> ox.NamedNode | None:
    return ox.NamedNode(str(iri)) if iri is not None else None


def _graph(random: Random) -> Graph:
    graph = Graph()
    spaces = [Namespace("http://example.org/lab#"), Namespace("https://e.org/other/")]
    for number, space in enumerate(spaces):
        graph.bind(f"p{number}", space)
    iris: list[Node] = [space[name] for space in spaces for name in NAMES]
    blanks: list[Node] = [BNode() for _ in range(3)]
    predicates = [spaces[0][f"r{n}"] for n in range(4)] + [RDF.type]
    for _ in range(random.randrange(1, 25)):
        subject = random.choice(iris + blanks)
        graph.add((subject, random.choice(predicates), random.choice([*iris, *blanks, _literal(random)])))
    head = BNode()
    Collection(graph, head, [random.choice([*iris, _literal(random)]) for _ in range(random.randrange(1, 4))])
    graph.add((random.choice(iris), predicates[0], head))
    return graph


def _literal(random: Random) -> Literal:
    text = random.choice(TEXTS)
    return random.choice(
        [
            Literal(text),
            Literal(text, lang=random.choice(["en", "de-CH"])),
            Literal(text, datatype=URIRef("http://example.org/lab#kind")),
            Literal(random.randrange(-9, 9)),
            Literal(f"{random.uniform(-9, 9):.3f}", datatype=XSD.decimal),
            Literal(random.random() < 0.5),
        ]
    )
