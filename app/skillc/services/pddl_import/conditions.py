"""Writes conditions and expressions of PDDL in the language."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from skillc.services.pddl_import.declarations import Symbol, Typed
from skillc.services.pddl_import.expressions import Missing, Node, refuse
from skillc.services.pddl_import.names import Names, to_variable
from skillc.services.pddl_import.reading import read_variables
from skillc.services.pddl_import.terms import Defined, Entry, Form, Property, Relation, Terms
from skillc_dsl.spelling import did_you_mean

IMPLIES, OR, AND, NOT, ATOM = range(5)
"""How strongly what a text consists of binds."""
SUM, PRODUCT, VALUE = range(3)
_COMPARISONS = ("=", "<", "<=", ">", ">=")


class Text(NamedTuple):
    """A condition or an expression, and how strongly its operator binds."""

    text: str
    rank: int

    def within(self, rank: int) -> str:
        """Return the text as an operand of what binds as strongly as `rank`."""
        return self.text if self.rank >= rank else f"({self.text})"


@dataclass(slots=True)
class Scope:
    """The variables that a condition may name, by their names in PDDL.

    `entries` are the parameters that a skill infers for things that stand for tuples, by what they stand for; None
    where it cannot have any: then such a thing is spoken of by `exists`.
    """

    variables: Mapping[str, tuple[str, Typed]]
    names: Names
    entries: dict[tuple[str, ...], tuple[str, Entry, tuple[str, ...]]] | None = None

    def inner(self, variables: Iterable[Typed]) -> tuple[Scope, tuple[tuple[str, Typed], ...]]:
        """Return the scope with further variables, and these, each with its name in the language."""
        made = tuple((self.names.give(to_variable(each.written)), each) for each in variables)
        known = {**self.variables, **{each.name: (name, each) for name, each in made}}
        return Scope(known, self.names, None), made


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes conditions with the terms of a library and the individuals of its scene.

    `entries` are the individuals that stand for tuples, once the scene has been written.
    """

    terms: Terms
    objects: Mapping[str, Typed] = field(default_factory=dict)
    entries: dict[tuple[str, ...], str] = field(default_factory=dict)

    def conjuncts(self, node: Node | None) -> Iterator[Node]:
        """Yield the conditions that a condition joins by `and`."""
        if node is None or (node.is_list and not node.items):
            return
        if node.head == "and":
            for each in node.rest:
                yield from self.conjuncts(each)
        else:
            yield node

    def condition(self, node: Node, scope: Scope) -> Text:
        """Return a condition; Missing if the language cannot say it, BrokenPddl if it is wrong."""
        match node.head:
            case "and" | "or" as word if len(node.items) > 1:
                rank = AND if word == "and" else OR
                parts = [self.condition(each, self._closed(scope, word)) for each in node.rest]
                return Text(f" {word} ".join(each.within(rank) for each in parts), rank) if parts[1:] else parts[0]
            case "and" | "or":
                raise Missing(node, f"`({node.head})` within a condition is not in the library")
            case "not" if len(node.items) == 2:
                return Text(f"not {self.condition(node.items[1], self._closed(scope)).within(NOT)}", NOT)
            case "imply" if len(node.items) == 3:
                left, right = (self.condition(each, self._closed(scope)) for each in node.rest)
                return Text(f"{left.within(OR)} implies {right.within(OR)}", IMPLIES)
            case "exists" | "forall" as word if len(node.items) == 3:
                return self._quantified(word, node, scope)
            case "preference":
                raise Missing(node, "a preference is not in the library: a plan need not regard it")
            case "=" if len(node.items) == 3 and self._is_term(node.items[1]):
                return Text(f"{self.term(node.items[1], scope)} == {self.term(node.items[2], scope)}", ATOM)
            case word if word in _COMPARISONS and len(node.items) == 3:
                left, right = (self.number(each, scope) for each in node.rest)
                return Text(f"{left.text} {'==' if word == '=' else word} {right.text}", ATOM)
            case _:
                return self.atom(node, scope)

    def _closed(self, scope: Scope, word: str = "") -> Scope:
        """Return the scope within what need not hold: no parameter is inferred from it."""
        return scope if word == "and" else Scope(scope.variables, scope.names, None)

    def _quantified(self, word: str, node: Node, scope: Scope) -> Text:
        inner, made = scope.inner(read_variables(node.items[1], self.terms.domain))
        body = self.condition(node.items[2], inner).text
        variables = ", ".join(f"{name}: {self.terms.class_of(each.types)}" for name, each in made)
        return Text(f"{word} {variables} ({body})" if made else body, ATOM)

    def atom(self, node: Node, scope: Scope) -> Text:
        """Return a predicate of terms; an empty text if it says no more than that its entry is inferred."""
        form, symbol = self.form(node)
        arguments = self.arguments(node, symbol, scope)
        match form:
            case Property(name=name):
                return Text(f"{arguments[0] if arguments else self.terms.world()}.{name} == true", ATOM)
            case Relation(name=name):
                return Text(f"{arguments[0]} {name} {arguments[1]}", ATOM)
            case Defined(name=name):
                left, right = self.sides_of_defined(arguments)
                return Text(f"{left} {name} {right}", ATOM)
            case Entry(value=value):
                entry = self.entry(form, arguments, scope)
                if entry is not None:
                    return Text(f"{entry}.{value} == true" if value else "", ATOM)
                return self._some_entry(form, arguments, scope, "{}." + f"{value} == true" if value else "")

    def sides_of_defined(self, arguments: tuple[str, ...]) -> tuple[str, str]:
        """Return the two sides of a defined relation."""
        padded = (*arguments, self.terms.world(), self.terms.world())
        return padded[0], padded[1]

    def _some_entry(self, form: Entry, arguments: tuple[str, ...], scope: Scope, also: str) -> Text:
        name = scope.names.give(to_variable(form.symbol.node.written))
        parts = [f"{name} {side} {argument}" for side, argument in zip(form.sides, arguments, strict=True)]
        parts += [also.format(name)] if also else []
        return Text(f"exists {name}: {form.cls} ({' and '.join(parts)})", ATOM)

    def entry(self, form: Entry, arguments: tuple[str, ...], scope: Scope) -> str | None:
        """Return the individual or the parameter that stands for these arguments; None if the scope cannot have one."""
        key = form.cls, *arguments
        if scope.entries is None:
            return self.entries.get(key) if form.value else None
        if key not in scope.entries:
            scope.entries[key] = scope.names.give(to_variable(form.symbol.node.written)), form, arguments
        return scope.entries[key][0]

    def form(self, node: Node) -> tuple[Form, Symbol]:
        """Return how the predicate of an atom is said."""
        known = self.terms.domain.predicates
        if not node.head:
            refuse(node, f"a condition is expected here, not `{node}`")
        if node.head not in known:
            refuse(node, f"there is no predicate `{node.items[0].written}`", did_you_mean(node.head, known))
        if node.head not in self.terms.forms:
            raise Missing(node, f"`{node.head}` is derived and has more than two parameters, which cannot be said")
        return self.terms.forms[node.head], known[node.head]

    def arguments(self, node: Node, symbol: Symbol, scope: Scope) -> tuple[str, ...]:
        """Return the arguments of a predicate or a function; BrokenPddl if their number or a type is wrong."""
        if len(node.rest) != len(symbol.parameters):
            count = len(symbol.parameters)
            refuse(
                node, f"`{symbol.node.written}` has {count} parameter{'' if count == 1 else 's'}, not {len(node.rest)}"
            )
        for argument, parameter in zip(node.rest, symbol.parameters, strict=True):
            self._check_type(argument, parameter, symbol, scope)
        return tuple(self.term(each, scope) for each in node.rest)

    def _check_type(self, node: Node, parameter: Typed, symbol: Symbol, scope: Scope) -> None:
        found = self._find(node, scope)
        domain = self.terms.domain
        below = (
            domain.is_a(mine, theirs) or domain.is_a(theirs, mine) for mine in found.types for theirs in parameter.types
        )
        if not any(below):
            kinds = " or ".join(f"`{domain.written[each]}`" for each in found.types)
            wanted = " or ".join(f"`{domain.written[each]}`" for each in parameter.types)
            refuse(node, f"`{node}` is of the type {kinds}, and `{symbol.node.written}` is of {wanted} here")

    def _find(self, node: Node, scope: Scope) -> Typed:
        if node.is_list:
            raise Missing(node, "an object that is the value of a function cannot be named")
        if node.word.startswith("?"):
            name = node.word.removeprefix("?")
            if name not in scope.variables:
                known = did_you_mean(node.word, (f"?{each}" for each in scope.variables))
                refuse(node, f"there is no variable `{node.written}`", known)
            return scope.variables[name][1]
        if node.word not in self.objects:
            refuse(node, f"there is no object `{node.written}`", did_you_mean(node.word, self.objects))
        return self.objects[node.word]

    def term(self, node: Node, scope: Scope) -> str:
        """Return a variable or an individual."""
        self._find(node, scope)
        if node.word.startswith("?"):
            return scope.variables[node.word.removeprefix("?")][0]
        return self.terms.individuals[node.word]

    def _is_term(self, node: Node) -> bool:
        functions = self.terms.domain.functions
        return (
            not node.is_list and not _is_number(node.word) and (node.word not in functions or node.word in self.objects)
        )

    def number(self, node: Node, scope: Scope) -> Text:
        """Return an expression with numbers."""
        if _is_number(node.word):
            return Text(_plain(node.word), VALUE)
        if node.head in ("+", "-", "*", "/") and len(node.items) > 1:
            return self._arithmetic(node, scope)
        return self._value(node, scope)

    def _arithmetic(self, node: Node, scope: Scope) -> Text:
        parts = [self.number(each, scope) for each in node.rest]
        if len(parts) == 1:
            return Text(f"0 - {parts[0].within(PRODUCT)}", SUM) if node.head == "-" else parts[0]
        rank = SUM if node.head in "+-" else PRODUCT
        first, *others = parts
        tail = "".join(f" {node.head} {each.within(rank + (node.head in '-/'))}" for each in others)
        return Text(first.within(rank) + tail, rank)

    def _value(self, node: Node, scope: Scope) -> Text:
        name = node.head or node.word
        if name in ("?duration", "#t"):
            raise Missing(node, f"`{name}` cannot be named outside of the duration")
        if name == self.terms.domain.cost:
            raise Missing(node, f"no condition reads `{name}`")
        form, arguments = self.function(node, scope)
        match form:
            case Entry(value=value):
                entry = self.entry(form, arguments, scope)
                if entry is None:
                    raise Missing(
                        node,
                        f"`{node}` stands within `or`, `not` or a quantifier, where the language has no name for it",
                    )
                return Text(f"{entry}.{value}", VALUE)
            case Property(name=term):
                return Text(f"{arguments[0] if arguments else self.terms.world()}.{term}", VALUE)

    def function(self, node: Node, scope: Scope) -> tuple[Property | Entry, tuple[str, ...]]:
        """Return how a function is said, and its arguments."""
        name = node.head or node.word
        functions = self.terms.domain.functions
        if name in self.terms.domain.object_functions:
            raise Missing(node, f"the value of `{name}` is an object, which is not in the library")
        if name not in functions:
            refuse(node, f"there is no function `{name}`", did_you_mean(name, functions))
        form = self.terms.functions[name]
        assert isinstance(form, Property | Entry), "functions are properties or have entries"
        own = node if node.is_list else Node(node.span, items=(node,))
        return form, self.arguments(own, functions[name], scope)


def root_scope(parameters: Iterable[Typed], names: Names) -> Scope:
    """Return the scope of parameters."""
    scope, _ = Scope({}, names).inner(parameters)
    return scope


def _is_number(word: str) -> bool:
    try:
        return abs(float(word)) < float("inf")
    except ValueError:
        return False


def _plain(word: str) -> str:
    value = float(word)
    text = str(int(value)) if value.is_integer() else repr(value)
    return text if value >= 0 else f"({text})"
