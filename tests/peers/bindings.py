"""Trees in BehaviorTree.CPP 4.8.2, which the package `behaviortreepy` brings along: loaded, ticked, traced.

The package registers nodes without ports. So each leaf that a file declares becomes a node of its own here, without
attributes, that reads and writes the blackboard where the attributes say. What a decorator of the package cannot do
(halt its child, notice that it is halted) makes a run incomparable, and `trace` says so.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any
from xml.etree.ElementTree import Element, SubElement, tostring

import behaviortreepy
from behaviortreepy import NodeStatus

from emit.tree_rules import Reader
from peers.scripted import GIVEN, MADE, TICK_S, TICKS, Script, Told, inputs, ports_of, shown

INCOMPARABLE = ("Timeout", "ForEach")
KINDS = {"double": "double", "int": "int", "unsigned int": "int", "bool": "bool", "std::string": "string", "": "string"}


@dataclass
class Stage:
    """What the leaves of a file share, without tree and factory: these hold the leaves where no collector sees it."""

    reader: Reader
    told: Told = field(default_factory=Told)
    now_ms: float = 0.0


class Loaded:
    """A file in the library; an error of the library comes out as RuntimeError."""

    def __init__(self, text: str) -> None:
        self.reader = Reader.of(text)
        self.stage = Stage(self.reader)
        self.factory = behaviortreepy.BehaviorTreeFactory()
        self._made = 0
        root = deepcopy(self.reader.root)
        for tree in root.findall("BehaviorTree"):
            self._replace(tree)
        self.tree = self.factory.create_tree_from_text(tostring(root, encoding="unicode"))
        for name, type_ in inputs(self.reader).items():
            getattr(self.tree.root_blackboard(), f"set_{KINDS[type_]}")(name, GIVEN[type_])

    @property
    def comparable(self) -> bool:
        """Whether the trace is that of the player, but for what is undone."""
        declared = {path[-1] for path in self.reader.names().values() if path[0] == ""}
        return not declared & set(INCOMPARABLE) and not any(each.tag in INCOMPARABLE for each in self.reader.nodes())

    def run(self) -> list[str]:
        """Tick to the end, or for some time, and return the trace."""
        for number in range(TICKS):
            self.stage.now_ms = number * TICK_S * 1000
            status = self.tree.tick_exactly_once()
            self.stage.told.tell("=", status.name)
            if status != NodeStatus.RUNNING:
                break
        self.tree.halt_tree()
        return [*self.stage.told.trace, f"end {status.name}"]

    def _replace(self, parent: Element) -> None:
        for index, child in enumerate(parent):
            self._replace(child)
            model = self.reader.models.get(child.tag)
            if child.tag == "Sleep" or model is not None:
                parent[index] = self._node(child, model)

    def _node(self, written: Element, model: Element | None) -> Element:
        self._made += 1
        tag = f"Node{self._made}"
        scripts = {name: value for name, value in written.attrib.items() if name[:3] == "_on"}
        if model is not None and model.tag == "Decorator":
            around = Element(tag, scripts)
            inner = SubElement(around, "Sequence")
            self._made += 1
            SubElement(inner, f"Node{self._made}")
            inner.extend(written)
            leaf = Leaf(self.stage, written)
            self.factory.register_simple_action(f"Node{self._made}", leaf.begin)
            self.factory.register_simple_decorator(tag, lambda status, node: status)
            return around
        if model is not None and model.tag == "Control":
            return self._in_the_end(written)
        leaf = Leaf(self.stage, written)
        if model is None:
            self.factory.register_simple_stateful_action(tag, leaf.sleep, leaf.slept)
        elif model.tag == "Condition":
            self.factory.register_simple_condition(tag, leaf.test)
        else:
            self.factory.register_simple_stateful_action(tag, leaf.start, leaf.running, leaf.halt)
        return Element(tag, scripts)

    def _in_the_end(self, written: Element) -> Element:
        """Return the second child after the first one, however that ends: the package has no nodes of this kind."""
        block, last = written
        entry = f"ended{self._made}"
        whole = Element("Sequence")
        SubElement(whole, "Script", code=f"{entry} := 1")
        tried = SubElement(whole, "Fallback")
        tried.append(block)
        SubElement(tried, "Script", code=f"{entry} := 0")
        SubElement(whole, "ForceSuccess").append(last)
        SubElement(whole, "ScriptCondition", code=f"{entry} == 1")
        return whole


class Leaf:
    """A leaf at one place of a file; trees that are called twice share it, so runs are told apart by node."""

    def __init__(self, stage: Stage, written: Element) -> None:
        self.stage, self.written, self.identity = stage, written, written.tag
        self.inputs = ports_of(stage.reader, written, "input_port")
        self.outputs = ports_of(stage.reader, written, "output_port")
        self.runs: dict[int, tuple[Script, int]] = {}
        self.until: dict[int, float] = {}

    def test(self, node: Any) -> NodeStatus:
        ok = self.stage.told.next(self.identity).chance % 4 != 0
        self.stage.told.tell("true" if ok else "false", self.identity, self._read(node))
        return NodeStatus.SUCCESS if ok else NodeStatus.FAILURE

    def begin(self, node: Any) -> NodeStatus:
        self.stage.told.tell("start", self.identity, self._read(node))
        if "item" in self.outputs:
            self._write(node, 0)
        return NodeStatus.SUCCESS

    def start(self, node: Any) -> NodeStatus:
        script = self.stage.told.next(self.identity)
        self.runs[node.uid()] = (script, script.ticks)
        self.stage.told.tell("start", self.identity, self._read(node))
        return self._step(node)

    def running(self, node: Any) -> NodeStatus:
        self.stage.told.tell("tick", self.identity)
        return self._step(node)

    def halt(self, node: Any) -> None:
        self.stage.told.tell("halt", self.identity)

    def sleep(self, node: Any) -> NodeStatus:
        written = self.written.attrib["msec"]
        duration = self._value(node, written, "unsigned int") if written.startswith("{") else written
        self.until[node.uid()] = self.stage.now_ms + float(str(duration))
        return self.slept(node)

    def slept(self, node: Any) -> NodeStatus:
        over = self.stage.now_ms >= self.until[node.uid()] - 1e-6
        return NodeStatus.SUCCESS if over else NodeStatus.RUNNING

    def _step(self, node: Any) -> NodeStatus:
        script, left = self.runs[node.uid()]
        self.runs[node.uid()] = (script, left - 1)
        if left > 1:
            return NodeStatus.RUNNING
        if script.ok:
            self._write(node, script.chance)
        return NodeStatus.SUCCESS if script.ok else NodeStatus.FAILURE

    def _read(self, node: Any) -> str:
        model = self.stage.reader.models[self.identity]
        defaults = {each.attrib["name"]: each.get("default") for each in model if each.tag == "input_port"}
        parts = []
        for name, type_ in sorted(self.inputs.items()):
            written = self.written.get(name, defaults[name])
            if written is not None:
                value = self._value(node, written, type_) if written.startswith("{") else written
                parts.append(f" {name}={'?' if value is None else shown(value, type_)}")
        return "".join(parts)

    def _write(self, node: Any, chance: int) -> None:
        board = node.config().blackboard
        for name, type_ in self.outputs.items():
            if name in self.written.attrib:
                getattr(board, f"set_{KINDS[type_]}")(self.written.attrib[name][1:-1], MADE[type_](chance))

    def _value(self, node: Any, pointer: str, type_: str) -> object:
        """Return what an entry holds: of the type, or text to be read as it; None if it is not set."""
        board = node.config().blackboard
        for kind in (KINDS[type_], "string", "double", "bool"):
            read: Callable[[str], object] = getattr(board, f"get_{kind}")
            try:
                return read(pointer[1:-1])
            except RuntimeError:
                continue
        return None
