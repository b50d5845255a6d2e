"""The world of a cell: its facts, things and writes, what is asked about it, and how it is changed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc.contract.values import CheckedBody, Why, check_why
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.labels.labelled import LabelledChange, LabelledFact

WorldFormat: TypeAlias = Literal["turtle", "rdfxml", "jsonld", "ntriples", "trig", "graph", "top-view"]
"""The forms of RDF, and pictures as SVG: the individuals with their relations, and what is where from above."""


class WorldFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A fact, and how it is known: `evidence` is None for what the scene or a person stated, and by whom or what."""

    fact: LabelledFact
    evidence: Evidence | None = None
    origin: str = ""


class WorldFacts(msgspec.Struct, frozen=True):
    """Some of the `total` facts that were asked for, of the world after the write `sequence`."""

    sequence: int
    total: int
    facts: tuple[WorldFact, ...]


class WorldText(msgspec.Struct, frozen=True):
    """A world after the write `sequence`, as text."""

    sequence: int
    text: str


class WorldWrite(msgspec.Struct, frozen=True):
    """A write to the world: its number, when it was made, who or what made it, how that is known, and the changes.

    `written_ns` is the wall time in ns since 1970, 0 if it is not known; `evidence` is None for what a person states.
    `undo` are the changes that lead back to the world before.
    """

    sequence: int
    written_ns: int
    origin: str
    evidence: Evidence | None
    changes: tuple[LabelledChange, ...]
    undo: tuple[LabelledChange, ...] = ()


class QueryRows(msgspec.Struct, frozen=True):
    """The answer to a query, of the world after the write `sequence`; `truncated` if there were more rows."""

    sequence: int
    columns: tuple[str, ...]
    rows: tuple[tuple[str | bool | int | float | None, ...], ...]
    truncated: bool = False


@dataclass(frozen=True, slots=True)
class PlacedThing:
    """A thing: name, classes, what its pose is stated relative to, pose in the world in m and degrees, size in m.

    `problem` says why its pose is not known; then position and angles are empty.
    """

    name: str
    classes: tuple[str, ...]
    stated: str
    position: tuple[float, ...]
    angles: tuple[float, ...]
    size: tuple[float, ...]
    problem: str | None = None


class StatableTerm(msgspec.Struct, frozen=True):
    """A relation or property that facts about a thing may have, and how such a fact is written.

    `type` is the type of the value in the language, such as `Force` or `Text`; of a relation, the classes of its
    objects. Numbers are in `unit`. `values` are the possible texts, if they are limited. A new fact about a
    `functional` term replaces the former one.
    """

    iri: str
    name: str
    kind: Literal["relation", "property"]
    type: str
    unit: str
    values: tuple[str, ...]
    objects: tuple[str, ...]
    functional: bool
    doc: str


class StatableFacts(msgspec.Struct, frozen=True):
    """The terms of facts about a thing; `things` are the individuals of each class that `objects` of a term names."""

    terms: tuple[StatableTerm, ...]
    things: dict[str, tuple[str, ...]]


EditText: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=2000)]


class WorldQuery(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A SPARQL query, SELECT, ASK or CONSTRUCT; the prefixes of the vocabulary are declared."""

    sparql: Annotated[str, msgspec.Meta(min_length=1, max_length=20_000)]


class WorldEdit(CheckedBody, frozen=True, forbid_unknown_fields=True):
    """Changes that are made together or not at all, and why.

    Each is a fact in the syntax in which facts are shown, such as `lab:Board-1.isClean == true`. `not` before a fact
    removes it, and `not INDIVIDUAL` removes all facts about an individual. Statements of Turtle are taken, too.
    """

    edits: Annotated[tuple[EditText, ...], msgspec.Meta(min_length=1, max_length=200)]
    why: Why

    def check(self) -> None:
        """Raise ValueError for a blank reason."""
        check_why(self.why)


class WorldPlacement(CheckedBody, frozen=True, forbid_unknown_fields=True):
    """Where a thing is, and why this is said: its position in m and a quaternion (w, x, y, z), in the world.

    It stays with what carries it. `thing` is an IRI or `prefix:name`.
    """

    thing: Annotated[str, msgspec.Meta(min_length=1, max_length=500)]
    pose: tuple[float, float, float, float, float, float, float]
    why: Why

    def check(self) -> None:
        """Raise ValueError for a blank reason."""
        check_why(self.why)


MAX_NUMBER = 2**63 - 1
IriText = Annotated[str, msgspec.Meta(max_length=500)]


class FactPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which facts: about an individual, or those of a class; names are IRIs or `prefix:name`.

    With `search` only those about individuals whose names, labels, classes or texts contain these words.
    """

    subject: IriText | None = None
    type: IriText | None = None
    search: IriText | None = None
    offset: Annotated[int, msgspec.Meta(ge=0, le=2**31)] = 0
    limit: Annotated[int, msgspec.Meta(ge=1, le=1000)] = 200


class TermSubject(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The thing about which facts are stated: an IRI or `prefix:name`."""

    subject: IriText


class DocumentForm(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """RDF in a format, `graph`, a picture of individuals and relations, or `top-view`; both pictures are SVG.

    With `everything` RDF has the facts of data sheets, too.
    """

    format: WorldFormat = "turtle"
    everything: bool = False


class WritePage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which writes: those before a number, the last one first, and how many at most."""

    before: Annotated[int, msgspec.Meta(ge=0, le=MAX_NUMBER)] | None = None
    limit: Annotated[int, msgspec.Meta(ge=1, le=1000)] = 100
