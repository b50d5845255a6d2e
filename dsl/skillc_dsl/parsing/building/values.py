"""Builds names, types and values."""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec import structs

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.messages import read_message
from skillc_dsl.parsing.building.places import Child, TreeBuilder
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Span

_QUANTITY = re.compile(r"([\d.]+(?:[eE][+-]?\d+)?)\s*(\S+)")


class ValueBuilder(TreeBuilder):
    """Builds names, types and values; a condition in parentheses is returned as is."""

    def name(self, children: list[Token]) -> s.Name:
        """`contain`, `skiros:contain`"""
        return s.Name(children[0].value, self.place(children[0]))

    plain = relation_name = callee = enum_value = name

    def label(self, token: Child) -> s.Name:
        """Return the name of a label, without its `:`."""
        span = self.place(token)
        text = token.value.removesuffix(":") if isinstance(token, Token) else ""
        return s.Name(text, Span(span.path, span.line, span.column, span.line, span.column + len(text)))

    def list_of(self, children: list[Child]) -> s.ListOf:
        """`[T]`"""
        return s.ListOf(self.type_at(children, 1), self.over(children))

    def of_dimension(self, children: list[Child]) -> s.OfDimension:
        """`Vector of Length`"""
        return s.OfDimension(self.as_name(children[0]), self.as_name(children[2]), self.over(children))

    def type_at(self, children: Sequence[Child], index: int) -> s.TypeName:
        """Return the child at `index`, which the grammar guarantees to be a type."""
        found = children[index]
        if not isinstance(found, s.TypeName):
            raise TypeError(f"a type was expected, not {found!r}")
        return found

    def quantity(self, children: list[Token]) -> s.Quantity:
        """`400 N/m`"""
        match = _QUANTITY.fullmatch(children[0].value)
        if match is None:
            raise ValueError(f"not a quantity: {children[0].value!r}")
        return s.Quantity(float(match[1]), match[2], self.place(children[0]))

    def number(self, children: list[Token]) -> s.Number:
        """`2`, `2.0`"""
        return s.Number(float(children[0].value), children[0].value, self.place(children[0]))

    def negative(self, children: list[Child]) -> s.Quantity | s.Number:
        """`-2`, `-2 N`"""
        match children[1]:
            case s.Quantity(value=value, unit=unit):
                return s.Quantity(-value, unit, self.over(children))
            case s.Number(value=value, text=text):
                return s.Number(-value, f"-{text}", self.over(children))
            case other:
                raise TypeError(f"a number was expected, not {other!r}")

    def opposite(self, children: list[Child]) -> s.Arithmetic:
        """`-normal`, which is `-1 * normal`"""
        minus = s.Number(-1.0, "-1", self.place(children[0]))
        return s.Arithmetic("*", minus, self.value(children[1]), self.over(children))

    def text(self, children: list[Token]) -> s.Text:
        """`"like this"`"""
        return self.string(children[0])

    def string(self, token: Child) -> s.Text:
        """Return a string without its quotes."""
        return s.Text(token.value[1:-1] if isinstance(token, Token) else "", self.place(token))

    def message(self, token: Child) -> s.Message:
        """Return a string by its parts; a brace that begins no name is reported."""
        message, problems = read_message(self.string(token))
        self.problems.extend(problems)
        return message

    def boolean(self, children: list[Token]) -> s.Boolean:
        """`true`, `false`"""
        return s.Boolean(children[0].value == "true", self.place(children[0]))

    def reference(self, children: list[s.Name]) -> s.NameReference:
        """A name used as a value."""
        return s.NameReference(children[0], children[0].span)

    def member(self, children: list[Child]) -> s.Member:
        """`of.property`"""
        return s.Member(self.value(children[0]), self.as_name(children[2]), self.over(children))

    def apply(self, children: list[Child]) -> s.Invoke:
        """`function(argument, ..)`"""
        arguments = tuple(self.value(child) for child in children[1:] if not isinstance(child, Token))
        return s.Invoke(self.as_name(children[0]), arguments, self.over(children))

    def sum(self, children: list[Child]) -> s.Arithmetic:
        """`left + right`, `left - right`, `left * right`, `left / right`"""
        left, operator, right = children
        match operator.value if isinstance(operator, Token) else "":
            case "+" | "-" | "*" | "/" as sign:
                return s.Arithmetic(sign, self.value(left), self.value(right), self.over(children))
            case other:
                raise ValueError(f"no arithmetic: {other!r}")

    product = sum

    def parentheses(self, children: list[Child]) -> Child:
        """Return the content of parentheses with its span extended to include them."""
        inner = children[1]
        return structs.replace(inner, span=self.over(children))  # type: ignore[type-var]

    def list_value(self, children: list[Child]) -> s.ListValue:
        """`[item, ..]`"""
        items = tuple(self.value(child) for child in children if not isinstance(child, Token))
        return s.ListValue(items, self.over(children))

    def as_name(self, child: Child) -> s.Name:
        """Return a child that the grammar guarantees to be a name."""
        if not isinstance(child, s.Name):
            raise TypeError(f"a name was expected, not {child!r}")
        return child

    def value(self, child: Child) -> s.Value:
        """Return a value; a condition in its place is reported and replaced by `true`."""
        if isinstance(child, s.Value):
            return child
        span = self.place(child)
        self.complain(span, "a condition stands where a value belongs", "a value is a number, a name or a property")
        return s.Boolean(True, span)

    def complain(self, span: Span, message: str, help_: str) -> None:
        """Report an error that the grammar does not exclude."""
        self.problems.append(Diagnostic("syntax", span, message, help_))
