"""The parser: an LALR(1) automaton over tokens, with the tables that were made from the grammar."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar

from skillc_dsl.parsing.tables import load_tables
from skillc_dsl.parsing.tokens import Token, Tree

V = TypeVar("V")
Make = Callable[[str, list[Any]], V]
"""Makes a value of the parts of a rule, which are tokens and other values; it gets the name of the rule."""


class MisfitError(Exception):
    """A token does not fit."""


class Parser(Generic[V]):
    """The stacks of states and of values while a file is parsed; `states` has one more.

    A value is a token, what `make` returns, or a list of such values as a tree; `depths` has of each how many parts
    that can be nested are in each other in it.
    """

    __slots__ = ("_make", "_tables", "depths", "states", "values")

    def __init__(self, make: Make[V]) -> None:
        self._make = make
        self._tables = load_tables()
        self.states = [self._tables.start]
        self.values: list[Token | Tree | V] = []
        self.depths: list[int] = []

    def feed(self, token: Token) -> None:
        """Take the next token; MisfitError if it does not fit, after the rules that it completes."""
        table, states, terminal = self._tables.states, self.states, token.type
        while True:
            target = table[states[-1]].get(terminal)
            if target is None:
                raise MisfitError
            if target >= 0:
                states.append(target)
                self.values.append(token)
                self.depths.append(0)
                return
            self._reduce(~target)

    def finish(self, end: Token) -> Token | Tree | V:
        """Take the end of the file, and return the value of the whole; MisfitError if something is missing."""
        table, states = self._tables.states, self.states
        while states[-1] != self._tables.end:
            target = table[states[-1]].get(end.type)
            if target is None:
                raise MisfitError
            self._reduce(~target)
        return self.values[-1]

    def cut(self, count: int) -> list[Token | Tree | V]:
        """Drop all values but the first ones; return those that were dropped."""
        dropped = self.values[count:]
        del self.states[count + 1 :], self.values[count:], self.depths[count:]
        return dropped

    def _reduce(self, number: int) -> None:
        rule = self._tables.rules[number]
        states, values, depths = self.states, self.values, self.depths
        parts: list[Any] = []
        depth, size = 0, rule.size
        if size == 1:
            last = values[-1]
            if rule.is_list and rule.spread and isinstance(last, Tree):  # a list of nothing but a list
                last.data = rule.origin
                states[-1] = self._tables.states[states[-2]][rule.origin]
                return
            states.pop()
            parts, depth = [values.pop()], depths.pop()
        elif size:
            parts, depth = values[-size:], max(depths[-size:])
            del values[-size:], states[-size:], depths[-size:]
        if rule.spread:
            parts = _spread(parts, rule.spread)
        if rule.is_list:
            values.append(Tree(rule.origin, parts))
        elif rule.replaces_one and len(parts) == 1:
            values.append(parts[0])
        else:
            values.append(self._make(rule.name, parts))
        states.append(self._tables.states[states[-1]][rule.origin])
        depths.append(depth + rule.is_nested)


def _spread(parts: list[Any], places: tuple[int, ...]) -> list[Any]:
    """Return parts with lists taken apart; a list at the beginning, which may be long, takes the others."""
    begins = places[0] == 0
    spread: list[Any] = parts[0].children if begins else parts[: places[0]]
    for at in range(1 if begins else places[0], len(parts)):
        if at in places:
            spread += parts[at].children
        else:
            spread.append(parts[at])
    return spread


def parse_tree(tokens: tuple[Token, ...]) -> Tree:
    """Return the tree of tokens of which the last is the end; MisfitError if one does not fit."""
    parser = Parser(Tree)
    for token in tokens[:-1]:
        parser.feed(token)
    whole = parser.finish(tokens[-1])
    assert isinstance(whole, Tree)
    return whole
