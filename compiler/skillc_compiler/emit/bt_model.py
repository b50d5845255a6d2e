"""The nodes that a file of trees uses, as its TreeNodesModel declares them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal
from xml.etree.ElementTree import Element, SubElement

Kind = Literal["Action", "Condition", "Control", "Decorator", "SubTree"]


@dataclass(frozen=True)
class Port:
    """A port: what flows through it where, and its default."""

    name: str
    direction: Literal["input", "output", "inout"] = "input"
    default: str | None = None
    doc: str = ""


@dataclass
class Model:
    """Collects declarations; a node declared twice must be declared alike."""

    _declared: dict[str, tuple[Kind, tuple[Port, ...], str]] = field(default_factory=dict)

    def declare(self, kind: Kind, identity: str, ports: Sequence[Port], doc: str = "") -> None:
        """Declare a node; ValueError if another one has its ID."""
        declaration = (kind, tuple(ports), doc)
        if self._declared.setdefault(identity, declaration) != declaration:
            raise ValueError(f"two nodes are called {identity}")

    def element(self) -> Element:
        """Return the TreeNodesModel, in order of the IDs."""
        model = Element("TreeNodesModel")
        for identity, (kind, ports, doc) in sorted(self._declared.items()):
            node = SubElement(model, kind, ID=identity)
            if doc:
                SubElement(node, "description").text = doc
            node.extend(_ports(ports))
        return model


def _ports(ports: Iterable[Port]) -> list[Element]:
    elements = []
    for each in ports:
        element = Element(f"{each.direction}_port", name=each.name)
        if each.default is not None:
            element.set("default", each.default)
        element.text = each.doc or None
        elements.append(element)
    return elements
