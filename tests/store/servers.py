"""SPARQL 1.1 servers on loopback: rdflib-endpoint in a process of its own, and Oxigraph behind a plain HTTP server.

The first starts as `python -c RDFLIB PORT`; rdflib-endpoint and uvicorn come with the `dev` extra.
"""

from __future__ import annotations

import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pyoxigraph as ox

from waiting import wait_until

RDFLIB = """
import sys, uvicorn
from rdflib import Dataset
from rdflib_endpoint import SparqlEndpoint
uvicorn.run(SparqlEndpoint(graph=Dataset(), enable_update=True), port=int(sys.argv[1]), log_level="warning")
"""
"""rdflib behind its HTTP server."""


@contextmanager
def oxigraph(kept: ox.Store | None = None, port: int = 0) -> Iterator[str]:
    """Start Oxigraph behind a plain HTTP server in this process, with what was kept; yield its address."""
    store, one_at_a_time = ox.Store() if kept is None else kept, threading.Lock()

    class Handler(BaseHTTPRequestHandler):
        protocol_version, wbufsize = "HTTP/1.1", -1

        def do_POST(self) -> None:
            text = self.rfile.read(int(self.headers["Content-Length"])).decode()
            try:
                with one_at_a_time:
                    kind, body = self._done(text)
            except (SyntaxError, LookupError) as error:
                kind, body = "", str(error).encode()
            self.send_response(200 if kind else 404 if "path" in body.decode() else 400)
            self.send_header("Content-Type", kind or "text/plain")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def _done(self, text: str) -> tuple[str, bytes]:
            if self.path == "/update":
                store.update(text)
                return "text/plain", b""
            if self.path != "/query":
                raise LookupError("no such path")
            found = store.query(text)
            if isinstance(found, ox.QueryTriples):
                return "application/n-triples", found.serialize(format=ox.RdfFormat.N_TRIPLES) or b""
            return "application/sparql-results+json", found.serialize(format=ox.QueryResultsFormat.JSON) or b""

        def log_message(self, format: str, *args: object) -> None:
            return

    with serving(Handler, port) as address:
        yield address


@contextmanager
def serving(handler: type[BaseHTTPRequestHandler], port: int = 0) -> Iterator[str]:
    """Answer requests on a port, 0 for a free one, in threads of this process; yield the address."""
    server = ThreadingHTTPServer(("127.0.0.1", port), handler)
    server.daemon_threads = True
    thread = threading.Thread(target=server.serve_forever, args=(0.02,))
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


@contextmanager
def rdflib_endpoint() -> Iterator[str]:
    """Start rdflib-endpoint, with uvicorn, in a process of its own; yield its address."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    server = subprocess.Popen(
        [sys.executable, "-c", RDFLIB, str(port)], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL
    )
    try:
        _wait_for(port)
        yield f"http://127.0.0.1:{port}/"
    finally:
        server.terminate()
        server.wait()


SERVERS: dict[str, Callable[[], AbstractContextManager[str]]] = {"oxigraph": oxigraph, "rdflib": rdflib_endpoint}


def _wait_for(port: int) -> None:
    def answers() -> bool:
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", port)) == 0

    wait_until(answers, 0.1)
