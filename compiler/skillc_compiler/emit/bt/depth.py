"""Trees that are nested deeper than BehaviorTree.CPP reads are cut: it refuses more than 256 levels in one tree."""

from __future__ import annotations

from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.model import Model
from skillc_compiler.emit.bt.names import Names

DEEPEST = 200


def cut(tree: Element, names: Names, model: Model) -> list[Element]:
    """Return the tree, and those that hold what is too deep in it; they share its blackboard."""
    parts = [tree]
    for part in parts:
        for parent, index in _too_deep(part):
            path = ("", "part", tree.get("ID", ""), str(len(parts)))
            identity = names.of(*path)
            model.declare("SubTree", identity, path, (), f"A part of {tree.get('ID')} that is nested too deep in it.")
            parts.append(Element("BehaviorTree", ID=identity))
            parts[-1].append(parent[index])
            parent[index] = Element("SubTree", ID=identity, _autoremap="true")
    return parts


def _too_deep(tree: Element) -> list[tuple[Element, int]]:
    """Return the places below which nodes are too deep, each as a parent and the number of its child."""
    level = [tree]
    for _ in range(DEEPEST - 1):
        level = [child for parent in level for child in parent]
    return [(parent, index) for parent in level for index, child in enumerate(parent) if len(child)]
