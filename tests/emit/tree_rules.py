"""The rules of BehaviorTree.CPP's XML, version 4, that a file of trees has to keep."""

from __future__ import annotations

import re
from collections import Counter
from xml.etree.ElementTree import Element, fromstring

CHILDREN = {
    "Condition": (0, 0), "Action": (0, 0), "SubTree": (0, 0), "Sleep": (0, 0), "AlwaysSuccess": (0, 0),
    "AlwaysFailure": (0, 0), "Decorator": (1, 1), "Inverter": (1, 1), "ForceSuccess": (1, 1), "Repeat": (1, 1),
    "RetryUntilSuccessful": (1, 1), "RunOnce": (1, 1), "Timeout": (1, 1), "IfThenElse": (2, 3), "Sequence": (1, 99),
    "Fallback": (1, 99), "ReactiveSequence": (1, 99), "ReactiveFallback": (1, 99), "Parallel": (1, 99),
    "Control": (1, 99),
}  # fmt: skip
DECLARED = {"Action", "Condition", "Control", "Decorator", "SubTree"}
NOT_PORTS = {"ID", "_description"}


def broken_rules(text: str) -> list[str]:
    """Return a sentence for each rule that the file breaks."""
    root = fromstring(text)
    found = nodes(root)
    return [*_of_file(root), *(words for node in found for words in _of_node(node, root))]


def nodes(root: Element) -> list[Element]:
    """Return all nodes of all trees."""
    return [node for tree in root.findall("BehaviorTree") for node in tree.iter() if node is not tree]


def _of_file(root: Element) -> list[str]:
    trees = Counter(tree.get("ID") for tree in root.findall("BehaviorTree"))
    return [
        words
        for words, kept in (
            ("the format is not 4", root.get("BTCPP_format") == "4"),
            ("the main tree is missing", root.get("main_tree_to_execute") in trees),
            ("two trees have one ID", set(trees.values()) == {1}),
            ("a tree has not exactly one root", all(len(tree) == 1 for tree in root.findall("BehaviorTree"))),
        )
        if not kept
    ]


def _of_node(node: Element, root: Element) -> list[str]:
    name = f"{node.tag} {node.get('ID', '')}"
    least, most = CHILDREN[node.tag]
    words = [] if least <= len(node) <= most else [f"{name} has {len(node)} children"]
    if {"_while", "_failureIf"} & node.attrib.keys():
        words.append(f"{name} hides a condition in an attribute")
    return words + (_of_declared(node, name, root) if node.tag in DECLARED else [])


def _of_declared(node: Element, name: str, root: Element) -> list[str]:
    declared = root.findall(f"TreeNodesModel/{node.tag}[@ID='{node.get('ID')}']")
    ports = _ports(declared[0]) if declared else {}
    called = root.find(f"BehaviorTree[@ID='{node.get('ID')}']") if node.tag == "SubTree" else None
    passed = node.attrib.keys() - NOT_PORTS
    mandatory = {each for each, default in ports.items() if not default} if called is not None else set()
    return [
        words
        for words, kept in (
            (f"{name} is not declared once", len(declared) == 1),
            (f"{name} is no legal ID", re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", node.get("ID", "")) is not None),
            (f"{name} uses an undeclared port", passed <= ports.keys() | _entries(called)),
            (f"{name} calls a tree that is not in the file", node.tag != "SubTree" or called is not None),
            (
                f"{name} leaves out a mandatory port",
                mandatory <= passed,
            ),
            (f"{name} hides the default of a port", not _hidden(node, ports, root)),
        )
        if not kept
    ]


def _ports(declared: Element) -> dict[str, str]:
    """Return the ports of a model with their defaults; an empty default is none."""
    return {each.get("name", ""): each.get("default", "") for each in declared if each.tag.endswith("_port")}


def _entries(tree: Element | None) -> set[str]:
    """Return the entries of the blackboard that a tree speaks of: a call may map them without declaring them."""
    values = [value for node in tree.iter() for value in node.attrib.values()] if tree is not None else []
    return {value[1:-1] for value in values if re.fullmatch(r"\{.*\}", value)}


def _hidden(node: Element, ports: dict[str, str], root: Element) -> set[str]:
    """Return the ports with a default that the main tree maps to an entry, which nobody has set yet."""
    main = root.find(f"BehaviorTree[@ID='{root.get('main_tree_to_execute')}']")
    if main is None or node not in list(main):
        return set()
    return {each for each, default in ports.items() if default and node.get(each, "").startswith("{")}
