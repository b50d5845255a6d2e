"""Finds the ranges of numbers that actions change, from what actions need before they change them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from math import inf, prod

from skillc.services.pddl_import.declarations import Action, Domain, Problem, Typed
from skillc.services.pddl_import.expressions import Node
from skillc.services.pddl_import.reading import read_variables

CHANGES = {"increase": "+=", "decrease": "-=", "assign": ":=", "scale-up": "*", "scale-down": "/"}
"""The effects on numbers, and what they do to them."""
MOST_CHANGES, MOST_ROUNDS = 20_000, 12
"""How many changes, with objects for their variables, are looked at, and how often before a range has no end."""
Range = tuple[float, float]
Linear = Mapping[str, float]
"""A sum of numbers of things, each times a factor; that of "" is a constant."""


def find_ranges(domain: Domain, problem: Problem) -> dict[str, Range]:
    """Return the least and the greatest value of each function that actions change, as far as they are bounded.

    A range follows from the values at first and from what actions need: it forbids no step that the domain allows. It
    contains the former, and no action leads out of it, by the arithmetic of intervals (Cousot and Cousot 1977).
    """
    values = {str(node): number for node, number in _list_values(problem)}
    changes = _ground_changes(domain, problem)
    if changes is None:
        return {}
    ranges = {name: (number, number) for name, number in values.items()}
    while grown := _grow(changes, ranges):
        ranges |= dict.fromkeys(grown, (-inf, inf))
    found: dict[str, Range] = {}
    for name in sorted({each.number for each in changes} & ranges.keys()):
        low, high = found.get(_function(name), (inf, -inf))
        found[_function(name)] = min(low, ranges[name][0]), max(high, ranges[name][1])
    return {name: each for name, each in found.items() if -inf < each[0] and each[1] < inf}


def _function(number: str) -> str:
    return number.strip("()").split()[0]


@dataclass(frozen=True, slots=True)
class _Change:
    """What a number is afterwards; each of `known` is at least 0 before."""

    number: str
    after: Linear | None
    known: tuple[Linear, ...]


def _grow(changes: Iterable[_Change], ranges: dict[str, Range]) -> set[str]:
    """Extend the ranges until no change leads out of them; return those that do not end."""
    grown = set[str]()
    for _ in range(MOST_ROUNDS):
        grown = set()
        for each in changes:
            low, high = ranges.get(each.number, (inf, -inf))
            least, greatest = _bound(each, ranges)
            if least < low or greatest > high:
                ranges[each.number] = min(low, least), max(high, greatest)
                grown.add(each.number)
        if not grown:
            return grown
    return grown


def _bound(change: _Change, ranges: Mapping[str, Range]) -> Range:
    """Return between which values a number is after a change; (inf, -inf) if it cannot happen."""
    if change.after is None:
        return -inf, inf
    if {name for each in (change.after, *change.known) for name in each if name} - ranges.keys():
        return inf, -inf  # a number that it reads has no value
    if any(_interval(each, ranges)[1] < 0 for each in change.known):
        return inf, -inf
    nothing: Linear = {}
    lows = (_interval(_add(change.after, each, -1), ranges)[0] for each in (nothing, *change.known))
    highs = (_interval(_add(change.after, each, 1), ranges)[1] for each in (nothing, *change.known))
    return max(lows), min(highs)


def _interval(sum_: Linear, ranges: Mapping[str, Range]) -> Range:
    low = high = sum_.get("", 0.0)
    for name, factor in sum_.items():
        if name and factor:
            ends = [factor * each for each in ranges[name]]
            low, high = low + min(ends), high + max(ends)
    return low, high


def _add(one: Linear, other: Linear, factor: float) -> Linear:
    return {name: one.get(name, 0.0) + factor * other.get(name, 0.0) for name in (*one, *other)}


def _list_values(problem: Problem) -> Iterator[tuple[Node, float]]:
    for node in problem.init:
        if node.head == "=" and len(node.items) == 3:
            value = _linear(node.items[2])
            if value is not None:
                yield _in_list(node.items[1]), value.get("", 0.0)


def _ground_changes(domain: Domain, problem: Problem) -> list[_Change] | None:
    """Return what actions do to numbers with all objects; None if that is too much."""
    objects = {each.name: each for each in (*domain.constants, *problem.objects)}
    found: list[_Change] = []
    for action in domain.actions:
        length = _find_duration(action)
        guards = [each for each in _list_conditions(action.condition) if len(each.items) == 3]
        for written, variables in _list_effects(action.effect, (), domain):
            node = written.with_words(length)
            every = (*action.parameters, *variables)
            choices = [_list_objects(each, objects.values(), domain) for each in every]
            if len(found) + prod(map(len, choices)) > MOST_CHANGES:
                return None
            for chosen in product(*choices):
                words = {f"?{each.name}": own for each, own in zip(every, chosen, strict=True)}
                found.append(_ground(node.with_words(words), [each.with_words(words) for each in guards]))
    return found


def _find_duration(action: Action) -> dict[str, Node]:
    """Return what `?duration` stands for, if it is one value."""
    ends = (each for each in _list_conditions(action.duration) if len(each.items) == 3 and each.head == "=")
    return next(({"?duration": each.items[2]} for each in ends if each.items[1].word == "?duration"), {})


def _list_objects(variable: Typed, objects: Iterable[Typed], domain: Domain) -> list[Node]:
    pairs = ((each, own, wanted) for each in objects for own in each.types for wanted in variable.types)
    return list(dict.fromkeys(each.node for each, own, wanted in pairs if domain.is_a(own, wanted)))


def _list_conditions(node: Node | None) -> Iterator[Node]:
    """Yield what holds when an action starts."""
    if node is None:
        return
    if node.head == "and":
        for each in node.rest:
            yield from _list_conditions(each)
    elif len(node.items) == 3 and node.items[1].word in ("start", "all") and node.head in ("at", "over"):
        yield from _list_conditions(node.items[2])
    else:
        yield node


def _ground(effect: Node, guards: Iterable[Node]) -> _Change:
    kind, what, amount = effect.head, _in_list(effect.items[1]), _linear(effect.items[2])
    own: Linear = {str(what): 1.0}
    known = tuple(each for guard in guards for each in _list_known(guard))
    if amount is None:
        return _Change(str(what), None, known)
    match kind:
        case "assign":
            return _Change(str(what), amount, known)
        case "increase" | "decrease":
            return _Change(str(what), _add(own, amount, 1 if kind == "increase" else -1), known)
    factor = amount.get("", 0.0)
    if set(amount) - {""} or not factor:
        return _Change(str(what), None, known)
    return _Change(str(what), {str(what): factor if kind == "scale-up" else 1 / factor}, known)


def _list_known(guard: Node) -> Iterator[Linear]:
    """Yield what is at least 0 if a comparison holds."""
    sides = [_linear(each) for each in guard.rest]
    left, right = sides
    if left is None or right is None:
        return
    if guard.head in (">", ">=", "="):
        yield _add(left, right, -1)
    if guard.head in ("<", "<=", "="):
        yield _add(right, left, -1)


def _list_effects(
    node: Node | None, variables: tuple[Typed, ...], domain: Domain
) -> Iterator[tuple[Node, tuple[Typed, ...]]]:
    """Yield the effects on numbers, with the variables of the quantifiers around them."""
    if node is None:
        return
    if node.head in CHANGES and len(node.items) == 3:
        yield node, variables
    elif node.head == "forall" and len(node.items) == 3:
        yield from _list_effects(node.items[2], (*variables, *read_variables(node.items[1], domain)), domain)
    elif node.is_list:
        for each in node.rest:
            yield from _list_effects(each, variables, domain)


def _in_list(node: Node) -> Node:
    """Return a number as it is written with parentheses."""
    return node if node.is_list else Node(node.span, items=(node,))


def _linear(node: Node) -> Linear | None:
    """Return an expression as a sum; None if it is none."""
    try:
        return {"": float(node.word)}
    except ValueError:
        pass
    if node.head not in ("+", "-", "*", "/"):
        return {str(_in_list(node)): 1.0}
    sides = [_linear(each) for each in node.rest]
    if any(each is None for each in sides):
        return None
    first, *others = [each for each in sides if each is not None]
    if not others:
        return _add({}, first, -1 if node.head == "-" else 1)
    for each in others:
        product_ = _combine(node.head, first, each)
        if product_ is None:
            return None
        first = product_
    return first


def _combine(operator: str, left: Linear, right: Linear) -> Linear | None:
    if operator in "+-":
        return _add(left, right, 1 if operator == "+" else -1)
    factor, other = (right, left) if not set(right) - {""} else (left, right)
    number = factor.get("", 0.0)
    if set(factor) - {""} or (operator == "/" and (factor is left or not number)):
        return None
    return {name: each * number if operator == "*" else each / number for name, each in other.items()}
