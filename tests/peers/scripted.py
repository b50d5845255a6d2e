"""The trace of a file of trees whose nodes do what a script says: the player's, to be compared with the libraries'.

`scripted_nodes.h` says the same in C++: what a node does in its nth run follows from its ID and n.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple
from xml.etree.ElementTree import Element

from emit.bt_parts import Node, Outcome, Stage
from emit.bt_player import Player
from emit.tree_rules import Reader

TICK_S = 0.1
TICKS = 60
ITEMS = 2
GIVEN: Mapping[str, object] = {"double": 0.5, "int": 3, "unsigned int": 3, "bool": True, "std::string": "x"}
"""What the entries hold that the main tree reads."""


class Script(NamedTuple):
    """How long a run of a node takes, how it ends, and where its outputs come from."""

    ticks: int
    ok: bool
    chance: int


@dataclass
class Told:
    """What happens: how often each node was started, and the trace."""

    starts: Counter[str] = field(default_factory=Counter)
    trace: list[str] = field(default_factory=list)

    def next(self, identity: str) -> Script:
        """Return the script of the next run of a node."""
        value = 2166136261
        for byte in f"{identity}:{self.starts[identity]}".encode():
            value = (value ^ byte) * 16777619 % 2**32
        self.starts[identity] += 1
        value ^= value >> 15
        return Script(1 + value % 3, value // 3 % 10 != 0, value // 30)

    def tell(self, what: str, identity: str, more: str = "") -> None:
        """Write a line."""
        self.trace.append(f"{what} {identity}{more}")


class ScriptedPlayer(Player):
    """The player with scripted nodes in the place of those that a file declares."""

    def __init__(self, text: str, told: Told) -> None:
        super().__init__(text, Stage())
        self.told = told
        self.root.board.update({name: GIVEN[type_] for name, type_ in inputs(self.reader).items()})

    def declared(self, node: Node) -> Outcome | None:
        identity = node.element.tag
        match self.reader.models[identity].tag:
            case "Condition":
                ok = self.told.next(identity).chance % 4 != 0
                self.told.tell("true" if ok else "false", identity, self._read(node))
                return Outcome(ok)
            case "Action":
                return self._acted(node)
            case "Control":
                return super().declared(node)
            case _:
                return self._around(node)

    def halted(self, node: Node) -> None:
        word = {"Action": "halt", "Decorator": "undo"}
        if node.element.tag in self.names and (kind := self.reader.models[node.element.tag].tag) in word:
            self.told.tell(word[kind], node.element.tag)

    def _rounds(self, node: Node, count: int, *, until: bool) -> Outcome | None:
        """Tick the child; after a round that took several ticks, the library starts the next in the same tick."""
        while True:
            child = node.children[0]
            long = child.running
            outcome = super()._rounds(node, count, until=until)
            if outcome is not None or child.running or not long:
                return outcome

    def _acted(self, node: Node) -> Outcome | None:
        identity = node.element.tag
        script = node.state.get("script")
        if not isinstance(script, Script):
            script = node.state["script"] = self.told.next(identity)
            self.told.tell("start", identity, self._read(node))
        else:
            self.told.tell("tick", identity)
        left = node.state["left"] = int(str(node.state.get("left", script.ticks))) - 1
        if left > 0:
            return None
        if script.ok:
            self._write(node, script.chance)
        return Outcome(script.ok)

    def _around(self, node: Node) -> Outcome | None:
        """Tick a node with a child: once, or for every item."""
        identity = node.element.tag
        if not node.state:
            self.told.tell("start", identity, self._read(node))
        done = node.state.setdefault("done", 0)
        assert isinstance(done, int)
        several = "item" in self._types(node, "output_port")
        if several:
            self._write(node, 0)
        outcome = node.children[0].tick()
        if outcome is None:
            return None
        node.state["done"] = done + 1
        if several and outcome.ok and done + 1 < ITEMS:
            return None
        self.told.tell("undo", identity)
        return outcome

    def _read(self, node: Node) -> str:
        model = self.reader.models[node.element.tag]
        texts = {each.attrib["name"]: each.get("default") for each in model if each.tag == "input_port"}
        parts = []
        for name, type_ in sorted(self._types(node, "input_port").items()):
            written = node.element.get(name, texts[name])
            if written is not None:
                value = node.board.get(written[1:-1]) if written.startswith("{") else written
                parts.append(f" {name}={'?' if value is None else shown(value, type_)}")
        return "".join(parts)

    def _write(self, node: Node, chance: int) -> None:
        for name, type_ in self._types(node, "output_port").items():
            if name in node.element.attrib:
                node.board[node.element.attrib[name][1:-1]] = MADE[type_](chance)

    def _types(self, node: Node, kind: str) -> dict[str, str]:
        return ports_of(self.reader, node.element, kind)


MADE: Mapping[str, Callable[[int], object]] = {
    "double": lambda chance: chance % 8000 / 8.0,
    "int": lambda chance: chance % 5,
    "unsigned int": lambda chance: chance % 300,
    "bool": lambda chance: chance % 2 == 1,
    "std::string": lambda chance: f"t{chance % 10}",
    "": lambda chance: "1",
}


def ports_of(reader: Reader, element: Element, kind: str) -> dict[str, str]:
    """Return the types of the ports of a kind that a node has, by name."""
    model = reader.models.get(element.get("ID", element.tag))
    ports = [each for each in model if each.tag == kind] if model is not None else []
    return {each.attrib["name"]: each.get("type", "") for each in ports}


def inputs(reader: Reader) -> dict[str, str]:
    """Return the entries that the main tree reads and does not write, with the types that they are read as."""
    main = reader.trees[reader.root.attrib["main_tree_to_execute"]]
    found: dict[str, dict[str, str]] = {"input_port": {}, "output_port": {}}
    for element in main.iter():
        for kind, entries in found.items():
            for name, type_ in ports_of(reader, element, kind).items():
                if element.get(name, "").startswith("{"):
                    entries.setdefault(element.attrib[name][1:-1], type_)
    written = found["output_port"]
    return {name: type_ for name, type_ in found["input_port"].items() if type_ and name not in written}


def shown(value: object, type_: str) -> str:
    """Return a value as a port of the type reads it."""
    match type_:
        case "double":
            number = float(str(value))
            return "nan" if math.isnan(number) else f"{number:.17g}"
        case "int" | "unsigned int":
            return str(int(str(value)))
        case "bool":
            return "true" if value in (True, "true", "1") else "false"
        case "std::string":
            return '"' + str(value).replace("\n", "\\n").replace("\r", "\\r") + '"'
        case _:
            return "*"


def trace(text: str) -> list[str]:
    """Run the main tree of a file to its end, or for some time."""
    told = Told()
    player = ScriptedPlayer(text, told)
    for number in range(TICKS):
        player.stage.now = number * TICK_S
        outcome = player.tick()
        told.tell("=", status := "RUNNING" if outcome is None else "SUCCESS" if outcome.ok else "FAILURE")
        if outcome is not None:
            break
    player.root.halt()
    return [*told.trace, f"end {status}"]
