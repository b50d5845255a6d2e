"""Basics for writing trees: names, declarations, tests of conditions, values of expressions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

import msgspec

from skillc_compiler.emit.bt.model import Kind, Model, Port
from skillc_compiler.emit.bt.names import NodeIds, entry_name, port_name
from skillc_compiler.emit.bt.ports import format_plain_value, port_type
from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Expression, Variable
from skillc_model.format_condition import format_expression
from skillc_model.skills import Parameter, Post, SkillLibrary
from skillc_model.traversal import free_variables_in_order
from skillc_rdf.vocabulary.types import ValueType


class ParameterBinding(msgspec.Struct, frozen=True):
    """The blackboard entry that holds the value of a local name, and its C++ type (None: not known)."""

    entry: str
    type: str | None = None


@dataclass
class TreeWriter:
    """Writes one tree; `owner` is the path of names of the skill, implementation or task of the tree.

    `posts` are the postconditions that the body may apply, `bound` the names that are currently in scope.
    """

    library: SkillLibrary
    names: NodeIds
    model: Model
    owner: tuple[str, ...]
    posts: Sequence[Post] = ()
    bound: Mapping[str, ParameterBinding] = field(default_factory=dict)
    start: list[str] = field(default_factory=list)
    """Scripts that run each time the tree starts."""
    _made: dict[str, int] = field(default_factory=dict)
    _held: dict[str, ValueType | str | None] = field(default_factory=dict)
    """The types of the entries of outputs and loop variables."""

    def number(self, word: str) -> int:
        """Return the next number for this word, starting at 1."""
        self._made[word] = self._made.get(word, 0) + 1
        return self._made[word]

    def entry(self, word: str) -> str:
        """Return the name of a new blackboard entry."""
        return entry_name(word, self.number(f"entry {word}"))

    def at(self, name: str) -> ParameterBinding:
        """Return the binding of a name."""
        return self.bound.get(name, ParameterBinding(port_name(name)))

    def bind(self, name: str, type_: ValueType | None) -> ParameterBinding:
        """Bring a name of this type (None: not known) into scope, unless it already is, and return its binding.

        The type of an entry cannot change, so a name used with another type elsewhere gets another entry.
        """
        if name not in self.bound:
            plain = port_type(type_) if type_ else None
            held = plain or type_
            unused = port_name(name) not in self._held
            again = held is not None and self._held.get(port_name(name)) == held
            entry = port_name(name) if unused or again else self.entry(name)
            self._held[entry] = held
            self.bound = {**self.bound, name: ParameterBinding(entry, plain)}
        return self.bound[name]

    def apart(self, parts: Sequence[Callable[[], Element]]) -> list[Element]:
        """Return parts that do not see each other's names; later parts of the tree see the names of all."""
        before, found = self.bound, dict[str, ParameterBinding]()
        elements = []
        for part in parts:
            self.bound = before
            elements.append(part())
            found = {**self.bound, **found}
        self.bound = {**before, **found}
        return elements

    def ports(self, names: Sequence[str]) -> list[Port]:
        """Return the ports through which a node reads variables."""
        return [Port(port_name(name), type=self.at(name).type, parameter=name) for name in names]

    def reads(self, names: Sequence[str]) -> dict[str, str]:
        """Return the attributes through which a node reads variables."""
        return {port_name(name): pointer(self.at(name).entry) for name in names}

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
        return make_leaf(identity, self.reads(variables), source)

    def evaluate(self, expression: Expression, into: str, type_: str | None = None) -> Element:
        """Return the node that writes the value of an expression, of a C++ type if known, to an entry."""
        path = (*self.owner, "evaluate", into)
        identity = self.names.of(*path)
        read = free_variables_in_order(expression)
        result = _result(read)
        text = f"Computes: {format_expression(expression, self.library.vocabulary)}"
        ports = [*self.ports(read), Port(result, "output", type_)]
        self.model.declare("Action", identity, path, ports, text)
        return Element(identity, {**self.reads(read), result: pointer(into)})

    def converted(self, name: str, found: ParameterBinding, target: ParameterBinding) -> Element:
        """Return the node that converts the value in `found`, which is of another type, to `target`."""
        path = (*self.owner, "evaluate", found.entry)
        identity = self.names.of(*path)
        result = _result([name])
        ports = [Port(port_name(name), type=found.type, parameter=name), Port(result, "output", target.type)]
        self.model.declare("Action", identity, path, ports, f"Computes: {name}")
        return Element(identity, {port_name(name): pointer(found.entry), result: pointer(target.entry)})

    def value(self, word: str, expression: Expression, before: list[Element], type_: str | None = None) -> str:
        """Return the attribute that passes an expression to a port of a C++ type; nodes to compute it go to `before`.

        A variable of another type is converted: an entry has one type, and an Int may be passed for a Number.
        """
        if isinstance(expression, Variable) and type_ in (None, self.at(expression.name).type or type_):
            return pointer(self.at(expression.name).entry)
        plain = format_plain_value(expression, type_)
        if plain is not None:
            return plain
        into = self.entry(word)
        before.append(self.evaluate(expression, into, type_))
        return pointer(into)


def _result(read: Sequence[str]) -> str:
    """Return the name of the result port, different from the ports of the variables read."""
    name, taken = "value", {port_name(each) for each in read}
    while name in taken:
        name += "_"
    return name


def bind_parameters(parameters: Sequence[Parameter]) -> Mapping[str, ParameterBinding]:
    """Return the bindings of the parameters in the tree of a skill."""
    return {each.name: ParameterBinding(port_name(each.name), port_type(each.type)) for each in parameters}


def pointer(name: str) -> str:
    """Return how an attribute refers to an entry of the blackboard."""
    return f"{{{name}}}"


def make_leaf(identity: str, attributes: Mapping[str, str], source: Position) -> Element:
    """Return a leaf node with a reference to its source position."""
    return Element(identity, {**attributes, "_description": str(source)})


def with_children(parent: Element, *children: Element) -> Element:
    """Return the parent with the children appended."""
    parent.extend(children)
    return parent


def run_after(before: Sequence[Element], node: Element) -> Element:
    """Return the node, in a sequence after the nodes `before` if there are any."""
    return with_children(Element("Sequence"), *before, node) if before else node


def join_steps(steps: Sequence[Element]) -> Element:
    """Return the step if there is only one, otherwise a sequence of the steps."""
    return run_after(steps[:-1], steps[-1])
