"""What of a library its tests have run: skills, implementations, nodes of bodies, and conditions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias, get_args

import msgspec

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.skills import Compound, Implementation, SkillLibrary
from skillc_model.traversal import walk
from skillc_runtime.recording.events import Event, ImplementationChosen, NodeEnded, NodeStarted
from skillc_runtime.recording.failure import Failure

Kind: TypeAlias = Literal["skill", "implementation", "node", "condition"]
KINDS: tuple[Kind, ...] = ("skill", "implementation", "node", "condition")
Deciding: TypeAlias = tree.If | tree.While | tree.Check
"""Nodes whose condition is covered once it was true, and once false."""
NODES: tuple[type[tree.Node], ...] = get_args(tree.Node)
ITEM_NAMES = {"skill": "skills", "implementation": "implementations", "node": "nodes", "condition": "conditions"}


@dataclass(frozen=True, slots=True)
class CoverageItem:
    """Something that a test can cover, and where it is. `outcome` is that of a condition which counts once for each."""

    kind: Kind
    source: Position
    outcome: bool | None = None


@dataclass(slots=True)
class Coverage:
    """A listener that notes what the tests of a library cover of its own files; all runs share it."""

    items: frozenset[CoverageItem]
    _library: SkillLibrary
    _deciding: Mapping[Position, tree.Node]
    _covered: set[CoverageItem] = field(default_factory=set)
    _kinds: dict[int, tuple[str, Position]] = field(default_factory=dict)
    _chosen: dict[int, Implementation] = field(default_factory=dict)
    _branched: set[int] = field(default_factory=set)

    @staticmethod
    def of(library: SkillLibrary, files: Iterable[str]) -> Coverage:
        """Return that of a library before any test; `files` are the paths of its own texts."""
        paths = frozenset(files)
        deciding: dict[Position, tree.Node] = {
            each.source: each for each in _all_nodes(library) if isinstance(each, Deciding)
        }
        return Coverage(frozenset(each for each in list_items(library) if each.source.path in paths), library, deciding)

    @property
    def covered(self) -> frozenset[CoverageItem]:
        """What was covered."""
        return self.items & self._covered

    def __call__(self, event: Event) -> None:
        """Receive an event."""
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind, source=source):
                self._kinds[node] = kind, source
                self._branched.discard(node)
                self._add("node", source)
                self._note_branch(parent, source)
            case ImplementationChosen(node=node, skill=skill, implementation=name):
                self._choose(node, self._library.implementations[f"{skill}.{name}"])
            case NodeEnded():
                self._note_end(event)
            case _:
                pass

    def _choose(self, node: int, implementation: Implementation) -> None:
        self._chosen[node] = implementation
        self._add("implementation", implementation.source)
        self._add("skill", self._library.skills[implementation.skill].source)
        for each in (*implementation.pre, *implementation.hold):
            self._add("condition", each.source)

    def _note_branch(self, parent: int, branch: Position) -> None:
        """Note which branch of an `if`, or that a round of a `while`, was begun."""
        self._branched.add(parent)
        kind, source = self._kinds.get(parent, ("", branch))
        match self._deciding.get(source) if kind in ("if", "while") else None:
            case tree.If(then=then):
                self._decide(source, branch == then.source)
            case tree.While():
                self._decide(source, True)
            case _:
                pass

    def _note_end(self, event: NodeEnded) -> None:
        kind, source = self._kinds.get(event.node, ("", event.source))
        if kind == "check" and event.status in ("success", "failure"):
            self._decide(source, event.status == "success")
        elif (kind == "while" and event.status == "success") or (
            kind == "if" and event.status == "success" and event.node not in self._branched
        ):
            self._decide(source, False)
        chosen = self._chosen.pop(event.node, None)
        if chosen is not None and event.status == "success":
            for each in chosen.post:
                self._add("condition", each.source)
        if event.failure is not None:
            self._note_failure(event.failure)

    def _note_failure(self, failure: Failure) -> None:
        """Note the condition because of which something failed or did not start."""
        if failure.source is not None:
            self._add("condition", failure.source)
        for each in failure.causes:
            self._note_failure(each)

    def _decide(self, source: Position, outcome: bool) -> None:
        self._covered.add(CoverageItem("condition", source, outcome))

    def _add(self, kind: Kind, source: Position) -> None:
        self._covered.add(CoverageItem(kind, source))


def _all_nodes(library: SkillLibrary) -> Iterator[tree.Node]:
    """Yield the nodes of all bodies."""
    for implementation in library.implementations.values():
        if isinstance(implementation.body, Compound):
            yield from _nodes_in(implementation.body.node)


def _nodes_in(item: msgspec.Struct) -> Iterator[tree.Node]:
    for each in walk(item):
        if isinstance(each, NODES):
            yield each


def list_items(library: SkillLibrary) -> Iterator[CoverageItem]:
    """Yield all that tests can cover of a library, with what it imports."""
    for skill in library.skills.values():
        yield CoverageItem("skill", skill.source)
    for implementation in library.implementations.values():
        yield CoverageItem("implementation", implementation.source)
        conditions = (*implementation.pre, *implementation.hold)
        yield from (CoverageItem("condition", each.source) for each in conditions)
        yield from (CoverageItem("condition", each.source) for each in implementation.post)
    for node in _all_nodes(library):
        yield CoverageItem("node", node.source)
        if isinstance(node, Deciding):
            yield from (CoverageItem("condition", node.source, outcome) for outcome in (True, False))
