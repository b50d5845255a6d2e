"""The TreeNodesModel of a file: declarations of the nodes that its trees use."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal
from xml.etree.ElementTree import Element, SubElement

import msgspec

Kind = Literal["Action", "Condition", "Control", "Decorator", "SubTree"]
Direction = Literal["input", "output"]


class Port(msgspec.Struct, frozen=True):
    """A port: its name, direction, C++ type (None: any) and default, and the parameter that it stands for."""

    name: str
    direction: Direction = "input"
    type: str | None = None
    default: str | None = None
    doc: str = ""
    parameter: str = ""


class _Declaration(msgspec.Struct, frozen=True):
    kind: Kind
    path: tuple[str, ...]
    ports: tuple[Port, ...]
    doc: str


@dataclass
class Model:
    """Collects declarations; repeated declarations of a node must be equal."""

    _declared: dict[str, _Declaration] = field(default_factory=dict)

    def declare(self, kind: Kind, identity: str, path: tuple[str, ...], ports: Sequence[Port], doc: str = "") -> None:
        """Declare the node for this path of names; ValueError if the ID is declared differently."""
        declaration = _Declaration(kind, path, tuple(ports), doc)
        if self._declared.setdefault(identity, declaration) != declaration:
            raise ValueError(f"two nodes are called {identity}")

    def element(self) -> Element:
        """Return the TreeNodesModel, sorted by ID."""
        model = Element("TreeNodesModel")
        for identity, declared in sorted(self._declared.items()):
            node = SubElement(model, declared.kind, ID=identity)
            if declared.doc:
                SubElement(node, "description").text = declared.doc
            node.append(_names(declared))
            node.extend(_ports(declared.ports))
        return model


def _names(declared: _Declaration) -> Element:
    """Return the names behind the ID, and behind each port whose name differs from its parameter's."""
    fields = Element("MetadataFields")
    SubElement(fields, "Metadata", skillc="/".join(declared.path))
    for each in declared.ports:
        if each.parameter not in ("", each.name):
            SubElement(fields, "Metadata", {f"port_{each.name}": each.parameter})
    return fields


def _ports(ports: Iterable[Port]) -> list[Element]:
    elements = []
    for each in ports:
        element = Element(f"{each.direction}_port", name=each.name)
        if each.type is not None:
            element.set("type", each.type)
        if each.default is not None:
            element.set("default", each.default)
        element.text = each.doc or None
        elements.append(element)
    return elements
