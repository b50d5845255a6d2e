"""The types of blackboard entries as BehaviorTree.CPP 4.10 settles them when it makes the nodes of a main tree."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

BUILT_IN_PORTS: Mapping[str, Mapping[str, str]] = {
    "Sleep": {"msec": "unsigned int"},
    "Timeout": {"msec": "unsigned int"},
    "Repeat": {"num_cycles": "int"},
    "RetryUntilSuccessful": {"num_attempts": "int"},
    "Parallel": {"success_count": "int", "failure_count": "int"},
}
INT = re.compile(r"-?\d+")
DOUBLE = re.compile(r"-?((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf(inity)?|nan(\(\w*\))?)", re.IGNORECASE)


@dataclass
class Board:
    """The blackboard of a tree: the types of its own entries, and those that are its caller's."""

    parent: Board | None = None
    mapped: dict[str, str] = field(default_factory=dict)
    shared: bool = False
    types: dict[str, str | None] = field(default_factory=dict)

    def home(self, entry: str) -> tuple[Board, str]:
        """Return the board that holds an entry, and how it is called there."""
        if self.parent is not None and entry not in self.types and (self.shared or entry in self.mapped):
            return self.parent.home(self.mapped.get(entry, entry))
        return self, entry


def conflicts(trees: Mapping[str, Element], models: Mapping[str, Element], main: str) -> Iterator[str]:
    """Yield a sentence for each entry whose type changes."""
    if main in trees:
        yield from _below(trees[main][0], Board(), trees, models)


def _below(node: Element, board: Board, trees: Mapping[str, Element], models: Mapping[str, Element]) -> Iterator[str]:
    if node.tag == "SubTree":
        if node.get("ID") in trees:
            yield from _below(trees[node.attrib["ID"]][0], _called(node, board), trees, models)
        return
    for name, type_ in _types(node, models).items():
        if re.fullmatch(r"\{.+\}", node.get(name, "")):
            home, entry = board.home(node.attrib[name][1:-1])
            former = home.types.setdefault(entry, type_)
            if None not in (former, type_) and former not in (type_, "std::string"):
                yield f"the entry {entry} is {former} and later {type_}"
    for child in node:
        yield from _below(child, board, trees, models)


def _called(node: Element, board: Board) -> Board:
    """Return the board of a tree that is called; a constant has the type that its text looks like."""
    ports = {name: value for name, value in node.attrib.items() if name != "ID" and name[0] != "_"}
    mapped = {name: value[1:-1] for name, value in ports.items() if re.fullmatch(r" *\{.+\} *", value)}
    constants = {name: _guessed(value) for name, value in ports.items() if name not in mapped}
    return Board(board, mapped, node.get("_autoremap") == "true", constants)


def _guessed(value: str) -> str | None:
    if INT.fullmatch(value):
        return "int" if -(2**31) <= int(value) < 2**31 else "int64_t"
    return "double" if DOUBLE.fullmatch(value) else None


def _types(node: Element, models: Mapping[str, Element]) -> Mapping[str, str | None]:
    if node.tag not in models:
        return BUILT_IN_PORTS.get(node.tag, {})
    return {each.attrib["name"]: each.get("type") for each in models[node.tag] if each.tag.endswith("_port")}
