"""Turtle files as statements with their places, and the problems found in them."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import pyoxigraph as ox

from skillc_runtime.world.turtle import statements

BASE = "file:///scene"
Node = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple


@dataclass(frozen=True, slots=True)
class Document:
    """A Turtle file: what messages call it, and its text."""

    path: str
    text: str

    @staticmethod
    def read(path: Path) -> Document:
        """Read a file; SceneError when it cannot be read or is not UTF-8."""
        try:
            return Document(str(path), path.read_text("utf-8-sig"))
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
            raise SceneError(
                [SceneProblem(str(path), 1, 1, "unreadable-scene", f"cannot read {path}: {reason}")]
            ) from error


@dataclass(frozen=True, slots=True, order=True)
class SceneProblem:
    """A mistake in a Turtle file: where (line and column from 1), its kind, what is wrong, and what to do."""

    path: str
    line: int
    column: int
    name: str
    message: str
    help: str = ""

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.column}: {self.message}" + (f" ({self.help})" if self.help else "")


class SceneError(ValueError):
    """A scene that cannot be loaded, with everything that is wrong with it."""

    def __init__(self, problems: Iterable[SceneProblem]) -> None:
        self.problems = tuple(sorted(problems))
        super().__init__("\n".join(map(str, self.problems)))


@dataclass(frozen=True, slots=True)
class Placed:
    """A statement with the place of its object."""

    subject: Node
    predicate: str
    object: Node
    path: str
    line: int
    column: int

    def problem(self, name: str, message: str, help_: str = "") -> SceneProblem:
        """Return a problem at this place."""
        return SceneProblem(self.path, self.line, self.column, name, message, help_)


@dataclass(frozen=True, slots=True)
class Parsed:
    """The statements of a document in order, and its prefixes."""

    statements: tuple[Placed, ...]
    prefixes: dict[str, str]


def parse(document: Document) -> Parsed:
    """Read a document; SceneError with the line when it is not Turtle."""
    parser = ox.parse(document.text, format=ox.RdfFormat.TURTLE, base_iri=BASE)
    try:
        triples = list(parser)
    except SyntaxError as error:
        raise SceneError([_broken(document, error)]) from error
    places: dict[tuple[str, str, str | None], deque[tuple[int, int]]] = defaultdict(deque)
    for each in statements(document.text, BASE):
        places[each.subject, each.predicate, each.object].append((each.line, each.column))
    found: list[Placed] = []
    place = (1, 1)
    for triple in triples:
        known = places.get(_key(triple))
        place = known.popleft() if known else place
        found.append(Placed(triple.subject, triple.predicate.value, triple.object, document.path, *place))
    return Parsed(tuple(found), dict(parser.prefixes))


def resolved(placed: Placed, aliases: dict[str, str]) -> Placed:
    """Return the statement with terms called by their own names."""
    changed = replace(placed, predicate=aliases.get(placed.predicate, placed.predicate))
    if isinstance(placed.object, ox.NamedNode) and placed.object.value in aliases:
        return replace(changed, object=ox.NamedNode(aliases[placed.object.value]))
    return changed


def _key(triple: ox.Triple | ox.Quad) -> tuple[str, str, str | None]:
    subject = triple.subject.value if isinstance(triple.subject, ox.NamedNode) else ""
    return subject, triple.predicate.value, triple.object.value if isinstance(triple.object, ox.NamedNode) else None


def _broken(document: Document, error: SyntaxError) -> SceneProblem:
    reason = (error.msg or "").rpartition(": ")[2] or "something is missing"
    message = f"this is not Turtle: {reason}"
    return SceneProblem(document.path, error.lineno or 1, error.offset or 1, "broken-turtle", message)
