"""Finding out where a SPARQL server takes queries and where updates: the standard leaves that to the server."""

from __future__ import annotations

from skillc_runtime.store.address import Address
from skillc_runtime.store.http import TIMEOUT_S, Garbled, HttpEndpoint, Refused
from skillc_runtime.world.state.transactions import StoreError

FORMS = (("", ""), ("/query", "/update"), ("", "/statements"), ("/sparql", "/update"))
"""What servers put behind their address for queries and for updates: Fuseki and Virtuoso, Oxigraph, RDF4J, others."""
NOTHING_ASKED, NOTHING_DONE = "ASK {}", "INSERT DATA {}"
ROWS = "application/sparql-results+json"


def find_endpoint(address: str, timeout_s: float = TIMEOUT_S) -> HttpEndpoint:
    """Return a server that answers queries and makes updates; StoreError when there is none at the address."""
    name = Address.of(address)
    refusals: list[StoreError] = []
    for query, update in FORMS:
        endpoint = HttpEndpoint(address, query, update, timeout_s)
        try:
            endpoint.query(NOTHING_ASKED, ROWS)
            endpoint.update(NOTHING_DONE)
        except (Refused, Garbled) as error:
            refusals.append(error)
        else:
            return endpoint
        endpoint.close()
    raise StoreError(f"no SPARQL 1.1 server takes queries and updates at {name}: {refusals[-1]}")
