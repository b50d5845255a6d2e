"""A reader of BehaviorTree.CPP's XML, version 4, that is written after the format and knows nothing of the emitter."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from xml.etree.ElementTree import Element, fromstring

from emit.tree_entries import conflicts

LEAVES = {"Sleep", "AlwaysSuccess", "AlwaysFailure", "Script", "ScriptCondition"}
DECORATORS = {
    "Inverter", "ForceSuccess", "KeepRunningUntilFailure", "Repeat", "RetryUntilSuccessful", "Timeout",
}  # fmt: skip
CONTROLS = {"Sequence", "Fallback", "ReactiveSequence", "ReactiveFallback", "Parallel", "IfThenElse"}
REGISTERED = LEAVES | DECORATORS | CONTROLS
TAKEN = {"Root", "root", "TryCatch", "Switch3", "Precondition", "Delay", "RunOnce", "SetBlackboard", "LoopDouble"}
DEEPEST = 256
EXPLICIT = {"Action", "Condition", "Control", "Decorator"}


@dataclass(frozen=True)
class Reader:
    """A file of trees with what it declares."""

    root: Element

    @classmethod
    def of(cls, text: str) -> Reader:
        """Read a file."""
        return cls(fromstring(text))

    @property
    def trees(self) -> dict[str, Element]:
        """The trees by ID."""
        return {tree.attrib["ID"]: tree for tree in self.root.findall("BehaviorTree")}

    @property
    def models(self) -> dict[str, Element]:
        """What is declared, by ID."""
        return {model.attrib["ID"]: model for model in self.root.findall("TreeNodesModel/*")}

    def nodes(self) -> list[Element]:
        """Return all nodes of all trees."""
        return [node for tree in self.root.findall("BehaviorTree") for node in tree.iter() if node is not tree]

    def names(self) -> dict[str, tuple[str, ...]]:
        """Return the path of names that stands behind each declared ID."""
        found = {}
        for identity, model in self.models.items():
            fields = [each.attrib for each in model.findall("MetadataFields/Metadata")]
            (path,) = [each["skillc"] for each in fields if "skillc" in each]
            found[identity] = tuple(path.split("/"))
        return found

    def parameters(self, identity: str) -> dict[str, str]:
        """Return the parameter behind each port of a declared node."""
        model = self.models[identity]
        fields = [each.attrib for each in model.findall("MetadataFields/Metadata")]
        renamed = {name[5:]: value for each in fields for name, value in each.items() if name.startswith("port_")}
        return {name: renamed.get(name, name) for name in _ports(model)}


def broken_rules(text: str) -> list[str]:
    """Return a sentence for each rule that the file breaks."""
    reader = Reader.of(text)
    rules = [*_of_file(reader), *(words for node in reader.nodes() for words in _of_node(node, reader))]
    return rules or [*conflicts(reader.trees, reader.models, reader.root.attrib["main_tree_to_execute"])]


def _of_file(reader: Reader) -> list[str]:
    root = reader.root
    trees = Counter(tree.get("ID") for tree in root.findall("BehaviorTree"))
    models = Counter(model.get("ID") for model in root.findall("TreeNodesModel/*"))
    return _said(
        ("the format is not 4", root.get("BTCPP_format") == "4"),
        ("the main tree is missing", root.get("main_tree_to_execute") in trees),
        ("two trees have one ID", set(trees.values()) == {1}),
        ("two models have one ID", set(models.values()) <= {1}),
        ("a tree has the ID of a node", not trees.keys() & (REGISTERED | EXPLICIT)),
        ("a name means something else to the library", not (trees.keys() | models.keys()) & TAKEN),
        ("a tree is nested too deep", all(_depth(tree) <= DEEPEST for tree in root.findall("BehaviorTree"))),
        ("a tree has not exactly one root", all(len(tree) == 1 for tree in root.findall("BehaviorTree"))),
    )


def _depth(tree: Element) -> int:
    """Return how many levels of nodes are below the element of a tree."""
    depth, level = -1, [tree]
    while level:
        depth, level = depth + 1, [child for parent in level for child in parent]
    return depth


def _of_node(node: Element, reader: Reader) -> list[str]:
    if node.tag in EXPLICIT:
        return [f"{node.tag} is written out, which is refused below a ReactiveSequence"]
    if node.tag in REGISTERED:
        return _of_children(node, node.tag, _kind(node.tag))
    identity = node.get("ID", "") if node.tag == "SubTree" else node.tag
    if identity not in reader.models:
        return [f"{identity} is not declared"]
    model = reader.models[identity]
    return [*_of_children(node, identity, model.tag), *_of_declared(node, identity, model, reader)]


def _kind(tag: str) -> str:
    return "Decorator" if tag in DECORATORS else "Control" if tag in CONTROLS else "Action"


def _of_children(node: Element, identity: str, kind: str) -> list[str]:
    least, most = {"Control": (1, 999), "Decorator": (1, 1)}.get(kind, (0, 0))
    least, most = (2, 3) if identity == "IfThenElse" else (least, most)
    return [] if least <= len(node) <= most else [f"{identity} has {len(node)} children"]


def _of_declared(node: Element, identity: str, model: Element, reader: Reader) -> list[str]:
    ports = _ports(model)
    subtree = node.tag == "SubTree"
    passed = {name for name in node.attrib if not name.startswith("_")} - ({"ID"} if subtree else set())
    mandatory = {name for name, each in ports.items() if not each.get("default")} if subtree else set()
    accepted = ports.keys() | (_entries(reader.trees.get(identity)) if subtree else set())
    return _said(
        (f"{identity} is no legal ID", re.fullmatch(r"[A-Za-z]\w*", identity, re.ASCII) is not None),
        (f"{identity} uses an undeclared port", passed <= accepted),
        (f"{identity} has a reserved attribute", not passed & {"name", "ID"}),
        (f"{identity} calls a tree that is not in the file", not subtree or identity in reader.trees),
        (f"{identity} is a tree and called as a node", subtree == (model.tag == "SubTree")),
        (f"{identity} leaves out a mandatory port", mandatory <= passed),
        (f"{identity} hides the default of a port", not _hidden(node, ports, reader)),
        (f"{identity} is passed what is not of the port's type", not _mistyped(node, ports)),
    )


def _said(*rules: tuple[str, bool]) -> list[str]:
    return [words for words, kept in rules if not kept]


def _ports(model: Element) -> dict[str, Element]:
    return {each.attrib["name"]: each for each in model if each.tag.endswith("_port")}


def _entries(tree: Element | None) -> set[str]:
    """Return the entries of the blackboard that a tree speaks of: a call may map them without declaring them."""
    values = [value for node in tree.iter() for value in node.attrib.values()] if tree is not None else []
    return {value[1:-1] for value in values if re.fullmatch(r"\{.*\}", value)}


def _hidden(node: Element, ports: dict[str, Element], reader: Reader) -> set[str]:
    """Return the ports with a default that the main tree maps to an entry, which nobody has set yet."""
    main = reader.trees.get(reader.root.get("main_tree_to_execute", ""))
    if main is None or node not in list(main):
        return set()
    return {each for each, port in ports.items() if port.get("default") and node.get(each, "").startswith("{")}


def _mistyped(node: Element, ports: dict[str, Element]) -> set[str]:
    """Return the ports of numbers and truth values that are given text which the library's conversion refuses."""
    read = {"double": float, "int": int, "unsigned int": int, "bool": {"true": 1, "false": 0}.__getitem__}
    wrong = set()
    for name, port in ports.items():
        value = node.get(name, "{}")
        try:
            if not value.startswith("{"):
                read.get(port.get("type", ""), str)(value)  # type: ignore[operator]
        except (ValueError, KeyError):
            wrong.add(name)
    return wrong
