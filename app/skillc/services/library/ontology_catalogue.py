"""Reads OASIS XML catalogues, such as Protégé's `catalog-v001.xml`: in which file the ontology of an IRI is.

"XML Catalogs", OASIS standard V1.1, 2005: the entries `uri`, `system`, `rewriteURI`, `uriSuffix`, `group` and
`nextCatalog`. Nothing is fetched: an entry whose file is on the network is passed over.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import unquote, urljoin, urlsplit

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

NAME = "catalog-v001.xml"
_BASE = "{http://www.w3.org/XML/1998/namespace}base"
_EXACT = {"uri": "name", "system": "systemId"}


class Entry(NamedTuple):
    """Which IRIs a line is about, `kind` being `exact`, `prefix` or `suffix`, and the address of the file."""

    kind: str
    iri: str
    address: str

    def find(self, iri: str) -> str | None:
        """Return the address of an IRI; None if the entry is not about it."""
        if self.kind == "exact":
            return self.address if iri == self.iri else None
        if self.kind == "prefix":
            return self.address + iri[len(self.iri) :] if iri.startswith(self.iri) else None
        return self.address if iri.endswith(self.iri) else None


def find_in_catalogue(catalogue: Path, iri: str) -> Path | None:
    """Return the file that a catalogue names for an IRI: the longest entry counts. None without a file on disk."""
    stamp = catalogue.stat().st_mtime_ns if catalogue.is_file() else 0
    entries = _read(catalogue, stamp) if stamp else ()
    fitting = sorted(
        ((each.kind == "exact", len(each.iri)), address) for each in entries if (address := each.find(iri)) is not None
    )
    return next((file for _, address in reversed(fitting) if (file := to_path(address)) is not None), None)


def to_path(address: str) -> Path | None:
    """Return the file at an address, None if that is not on this machine, or if there is no file."""
    parts = urlsplit(address)
    if parts.scheme != "file":
        return None
    path = Path(unquote(parts.path))
    return path if path.is_file() else None


@lru_cache(maxsize=32)
def _read(catalogue: Path, _stamp: int) -> tuple[Entry, ...]:
    """Return the entries of a catalogue and of those that it names, each once; those of a damaged one are left out."""
    from xml.etree import ElementTree  # few ontologies have catalogues

    found: list[Entry] = []
    todo, seen = [catalogue.resolve()], set[Path]()
    while todo:
        current = todo.pop(0)
        if current in seen or not current.is_file():
            continue
        seen.add(current)
        try:
            root = ElementTree.fromstring(current.read_bytes())
        except (OSError, ElementTree.ParseError, ValueError):
            continue
        for kind, iri, address in _entries(root, current.as_uri()):
            if kind != "next":
                found.append(Entry(kind, iri, address))
            elif (other := to_path(address)) is not None:
                todo.append(other)
    return tuple(found)


def _entries(root: Element, base: str) -> Iterator[tuple[str, str, str]]:
    """Yield the kind, the IRI and the absolute address of each entry below an element."""
    base = urljoin(base, root.get(_BASE, ""))
    for each in root:
        tag, here = each.tag.rpartition("}")[2], urljoin(base, each.get(_BASE, ""))
        if tag == "group":
            yield from _entries(each, base)
        elif tag in _EXACT:
            yield "exact", each.get(_EXACT[tag], ""), urljoin(here, each.get("uri", ""))
        elif tag == "rewriteURI":
            yield "prefix", each.get("uriStartString", ""), urljoin(here, each.get("rewritePrefix", ""))
        elif tag == "uriSuffix":
            yield "suffix", each.get("uriSuffix", ""), urljoin(here, each.get("uri", ""))
        elif tag == "nextCatalog":
            yield "next", "", urljoin(here, each.get("catalog", ""))
