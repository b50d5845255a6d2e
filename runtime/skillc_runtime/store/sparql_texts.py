"""The SPARQL queries and updates of a store on a server.

Facts are in the graph `store#world`. The graph `store#log` has `store#this` with the number of the last transaction
and the scene with which the store was filled, and each transaction with its number, origin, changes, author and mark of
its writer.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import pyoxigraph as ox

from skillc_runtime.store.triples import TripleDifference

NS = "https://w3id.org/skillc/store#"
WORLD, LOG, STORE = f"<{NS}world>", f"<{NS}log>", f"<{NS}this>"
SEQUENCE, BEGINNING = f"<{NS}sequence>", f"<{NS}beginning>"
NUMBER, ORIGIN, CHANGES, MARK = f"<{NS}number>", f"<{NS}origin>", f"<{NS}changes>", f"<{NS}mark>"
AUTHOR = f"<{NS}author>"

FACTS = f"CONSTRUCT {{ ?s ?p ?o }} WHERE {{ GRAPH {WORLD} {{ ?s ?p ?o }} }}"

CREATE = f"""INSERT {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} 0 ; {BEGINNING} "" }} }}
WHERE {{ FILTER NOT EXISTS {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} ?n }} }} }}"""
"""Makes a server a store unless it is one."""

RESET = f"""DELETE {{ GRAPH {WORLD} {{ ?s ?p ?o }} }} WHERE {{ GRAPH {WORLD} {{ ?s ?p ?o }} }} ;
DELETE {{ GRAPH {LOG} {{ ?entry ?p ?o }} }} WHERE {{ GRAPH {LOG} {{ ?entry {NUMBER} ?n ; ?p ?o }} }} ;
DELETE {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} ?n ; {BEGINNING} ?b }} }}
INSERT {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} ?next ; {BEGINNING} "" . ?entry {NUMBER} ?next ; {ORIGIN} "reset" }} }}
WHERE {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} ?n ; {BEGINNING} ?b }}
  BIND (?n + 1 AS ?next) BIND (IRI(CONCAT("{NS}transaction/", STR(?n + 1))) AS ?entry) }}"""
"""Empties a store. The number is incremented, so that users of the former world notice."""


def head_query(number: int) -> str:
    """Return the query for the number of the last transaction, `n`, and the `mark` of transaction `number`."""
    return f"""SELECT ?n ?mark WHERE {{ GRAPH {LOG} {{
  {STORE} {SEQUENCE} ?n . OPTIONAL {{ {_entry(number)} {MARK} ?mark }} }} }}"""


def beginning_query() -> str:
    """Return the query for the number of the last transaction, `n`, and the first scene, `beginning`."""
    return f"SELECT ?n ?beginning WHERE {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} ?n ; {BEGINNING} ?beginning }} }}"


def log_query(sequence: int) -> str:
    """Return the query for the transactions after a number: `n`, `origin` and, if stored, `changes` and `author`."""
    return f"""SELECT ?n ?origin ?changes ?author WHERE {{ GRAPH {LOG} {{
  ?entry {NUMBER} ?n ; {ORIGIN} ?origin . OPTIONAL {{ ?entry {CHANGES} ?changes }}
  OPTIONAL {{ ?entry {AUTHOR} ?author }}
  FILTER (?n > {sequence}) }} }}"""


def write_update(change: TripleDifference, after: int, about: Mapping[str, str], beginning: str | None) -> str:
    """Return the update that makes a change if the last transaction is `after`; `about` is logged, by predicate."""
    logged = "".join(f" ; {predicate} {ox.Literal(text)}" for predicate, text in about.items())
    old, new = f"{STORE} {SEQUENCE} {after} .", f"{STORE} {SEQUENCE} {after + 1} ."
    if beginning is not None:
        old += f' {STORE} {BEGINNING} "" .'
        new += f" {STORE} {BEGINNING} {ox.Literal(beginning)} ."
    return f"""DELETE {{ GRAPH {WORLD} {{ {_text(change.removed)} }} GRAPH {LOG} {{ {old} }} }}
INSERT {{ GRAPH {WORLD} {{ {_text(change.added)} }}
  GRAPH {LOG} {{ {new} {_entry(after + 1)} {NUMBER} {after + 1}{logged} }} }}
WHERE {{ GRAPH {LOG} {{ {STORE} {SEQUENCE} {after} }} }}"""


def _entry(number: int) -> str:
    return f"<{NS}transaction/{number}>"


def _text(triples: Iterable[ox.Triple]) -> str:
    return "".join(f"{triple} .\n" for triple in triples)
