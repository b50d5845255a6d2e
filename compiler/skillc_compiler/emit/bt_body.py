"""What every part of a tree is written with: names, declarations, tests of conditions, values of expressions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt_model import Kind, Model, Port
from skillc_compiler.emit.bt_names import Names, entry, port
from skillc_compiler.emit.bt_ports import plain_value, port_type
from skillc_compiler.emit.phrases import expression_text
from skillc_compiler.library.conditions import Condition, Expression
from skillc_compiler.library.reading import free_variables_in_order
from skillc_compiler.library.skills import Parameter, Post, SkillLibrary
from skillc_compiler.library.vocabulary import Position, ValueType


@dataclass
class Writer:
    """Writes into one tree; `owner` is the path of names of whom the tree belongs to, `types` those of its parameters.

    `posts` are the postconditions that the body may apply.
    """

    library: SkillLibrary
    names: Names
    model: Model
    owner: tuple[str, ...]
    posts: Sequence[Post] = ()
    types: Mapping[str, ValueType] = field(default_factory=dict)
    start: list[str] = field(default_factory=list)
    """Scripts that the tree runs first, each time it starts."""
    _made: dict[str, int] = field(default_factory=dict)

    def number(self, word: str) -> int:
        """Return how often this word has been asked for, 1 at first."""
        self._made[word] = self._made.get(word, 0) + 1
        return self._made[word]

    def entry(self, word: str) -> str:
        """Return a new entry of the blackboard."""
        return entry(word, self.number(f"entry {word}"))

    def ports(self, names: Sequence[str]) -> list[Port]:
        """Return the ports through which a node reads variables."""
        return [Port(port(name), type=self._type(name), parameter=name) for name in names]

    def condition(self, path: tuple[str, ...], condition: Condition, text: str, source: Position) -> Element:
        """Return the test of a condition, declared as a node of its own."""
        return self.reading("Condition", path, free_variables_in_order(condition), text, source)

    def test(self, word: str, condition: Condition, text: str, source: Position) -> Element:
        """Return the test of a condition that has no label of its own."""
        return self.condition((*self.owner, f"{word}{self.number(word)}"), condition, text, source)

    def reading(
        self, kind: Kind, path: tuple[str, ...], variables: Sequence[str], text: str, source: Position
    ) -> Element:
        """Return a node that reads variables, declared with a text that says what it does."""
        identity = self.names.of(*path)
        self.model.declare(kind, identity, path, self.ports(variables), text)
        return leaf(identity, {port(name): pointer(port(name)) for name in variables}, source)

    def evaluate(self, expression: Expression, into: str, type_: str | None = None) -> Element:
        """Return the node that puts the value of an expression, of a C++ type if known, into an entry."""
        path = (*self.owner, "evaluate", into)
        identity = self.names.of(*path)
        read = free_variables_in_order(expression)
        result = "value_" if "value" in read else "value"
        text = f"Computes: {expression_text(expression, self.library.vocabulary)}"
        ports = [*self.ports(read), Port(result, "output", type_)]
        self.model.declare("Action", identity, path, ports, text)
        return Element(identity, {**{port(name): pointer(port(name)) for name in read}, result: pointer(into)})

    def value(self, word: str, expression: Expression, before: list[Element], type_: str | None = None) -> str:
        """Return what a port is given for an expression; what must be computed is, among the nodes `before`."""
        plain = plain_value(expression)
        if plain is not None:
            return plain
        into = self.entry(word)
        before.append(self.evaluate(expression, into, type_))
        return pointer(into)

    def _type(self, name: str) -> str | None:
        return port_type(self.types[name]) if name in self.types else None


def types_of(parameters: Sequence[Parameter]) -> Mapping[str, ValueType]:
    """Return the types of parameters by name."""
    return {each.name: each.type for each in parameters}


def pointer(name: str) -> str:
    """Return how an attribute refers to an entry of the blackboard."""
    return f"{{{name}}}"


def leaf(identity: str, attributes: Mapping[str, str], source: Position) -> Element:
    """Return a node that stands for something in a source."""
    return Element(identity, {**attributes, "_description": str(source)})


def holding(parent: Element, *children: Element) -> Element:
    """Return the parent with the children below it."""
    parent.extend(children)
    return parent


def after(before: Sequence[Element], node: Element) -> Element:
    """Return the node alone, or after others in a sequence."""
    return holding(Element("Sequence"), *before, node) if before else node


def sequence(steps: Sequence[Element]) -> Element:
    """Return the one step, or several as a sequence."""
    return after(steps[:-1], steps[-1])
