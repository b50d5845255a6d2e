"""Prints what ontologies hold."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from skillc.cli.layout import TerminalPage
from skillc.services.library.ontologies import OntologyDescription

LISTED = 12
"""The most names in one line."""


def format_descriptions(described: Sequence[OntologyDescription]) -> str:
    """Return what ontologies hold as text, one after another."""
    page = TerminalPage()
    return "\n\n".join("\n".join(page.columns([*_rows(each)])) for each in described)


def _rows(each: OntologyDescription) -> Iterator[tuple[str, str]]:
    yield each.file, f"{each.format}, {_count(each.triples, 'triple')}"
    for iri in each.iris:
        yield "ontology", f"<{iri}>"
    for iri, file in each.imports.items():
        yield "imports", f"<{iri}>: {'missing' if file is None else file or 'shipped'}"
    yield (
        "terms",
        f"{_count(each.classes, 'class')}, {_count(each.relations, 'relation')}, {_count(each.properties, 'property')}",
    )
    others = ((each.individuals, "individual"), (each.annotations, "annotation property"), (each.datatypes, "datatype"))
    if any(count for count, _ in others):
        yield "", ", ".join(_count(count, what) for count, what in others if count)
    for is_used, title in ((True, "axioms used"), (False, "axioms without effect")):
        if kinds := [f"{one.count} {one.kind}" for one in each.axioms if one.is_used == is_used]:
            yield title, ", ".join(kinds)
    for remark in each.remarks:
        yield "remark", remark
    yield from _mapping(each)
    if each.library is not None:
        yield (
            f"used by {each.library}",
            ", ".join(f"{one.term} ({one.path}:{one.line})" for one in each.used) or "nothing",
        )


def _mapping(each: OntologyDescription) -> Iterator[tuple[str, str]]:
    """Yield the shipped terms with the terms that are below them, and the terms that are below none."""
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for one in each.links:
        found[one.shipped, one.link].append(one.term)
    for (shipped, link), terms in sorted(found.items()):
        if link == "below":
            yield f"below {shipped}", _listed(sorted(terms))
    if same := sorted(shipped for shipped, link in found if link == "is"):
        yield "shipped terms", _listed(same)
    if each.unlinked:
        yield "below none", f"{_listed(list(each.unlinked))}: `--align` proposes"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names[:LISTED]) + (f" and {len(names) - LISTED} more" if names[LISTED:] else "")


def _count(number: int, what: str) -> str:
    many = {"class": "classes", "property": "properties", "annotation property": "annotation properties"}
    return f"{number} {what if number == 1 else many.get(what, f'{what}s')}"
