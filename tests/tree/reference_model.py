"""The world in which the reference of trees lives: how nodes end, what is around them, and what conditions say."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from typing import TypeAlias

from skillc_model.conditions import Compare, Condition, Individual, PropertyOf, Variable
from skillc_model.conditions import Literal as Constant
from skillc_model.skills import SkillLibrary
from tree.stage import Script


@dataclass(frozen=True)
class Result:
    """How a node ended, and whether it would still end so. `kind` is that of the failure, "" on success."""

    kind: str = ""
    still: Callable[[], bool] = lambda: True
    hold: bool = False
    refused: bool = False

    @property
    def ok(self) -> bool:
        return not self.kind


Life: TypeAlias = Generator[None, None, Result]


@dataclass(frozen=True)
class Wait:
    """A call that waits for a device, with the calls around it; `key` is what it will hold the device with."""

    key: tuple[object, ...]
    device: str
    calls: tuple[object, ...]


@dataclass
class Model:
    """The whole world of the reference: flags, time, scripts, locks, the calls that wait for them, and the log.

    The key of a lock names the branches of reactive selectors that it is in. In a `dry` one nothing is done: primitives
    run for ever, nothing is locked, a retry is judged by its first round, and a broken hold is a failure like others.
    """

    library: SkillLibrary
    scripts: dict[str, list[Script]]
    flags: dict[str, bool]
    now: float = 0.0
    log: list[tuple[float, str, str]] = field(default_factory=list)
    starts: dict[str, int] = field(default_factory=dict)
    locks: dict[str, list[tuple[object, ...]]] = field(default_factory=dict)
    waits: list[Wait] = field(default_factory=list)
    dry: bool = False

    def tell(self, what: str, name: str) -> None:
        self.log.append((self.now, what, name))

    def next_script(self, name: str) -> Script:
        number = self.starts.get(name, 0)
        self.starts[name] = number + 1
        return self.scripts[name][number % len(self.scripts[name])]


@dataclass
class Scope:
    """What is around a node: bindings, results of `once`, things to release, the calls that hold locks, branches."""

    bindings: dict[str, object] = field(default_factory=dict)
    once: dict[object, Result] = field(default_factory=dict)
    undo: list[tuple[str, object]] = field(default_factory=list)
    calls: tuple[object, ...] = ()
    branch: tuple[object, ...] = ()


class Child:
    """A child that is advanced by hand."""

    def __init__(self, life: Life) -> None:
        self.life = life
        self.result: Result | None = None

    def step(self) -> Result | None:
        try:
            next(self.life)
        except StopIteration as end:
            self.result = end.value
        return self.result


def close(children: list[Child | None]) -> None:
    """Halt the children that still run, the last first."""
    for child in reversed(children):
        if child is not None and child.result is None:
            child.life.close()


def all_still(results: list[Result]) -> Result:
    """Return the success of all."""
    return Result(still=lambda: all(result.still() for result in results))


def none_worked(results: list[Result]) -> Result:
    """Return the failure of all."""
    return Result("body", hold=any(result.hold for result in results))


def true(condition: Condition, model: Model, scope: Scope) -> bool:
    """Whether a flag is as compared with."""
    assert isinstance(condition, Compare) and isinstance(condition.left, PropertyOf)
    return model.flags[str(value_of(condition.left.of, scope))] == value_of(condition.right, scope)


def value_of(expression: object, scope: Scope) -> object:
    """Return what an expression of a tree stands for."""
    match expression:
        case Individual(iri=iri):
            return iri
        case Constant(value=value):
            return value
        case Variable(name=name):
            return scope.bindings[name]
    raise NotImplementedError(expression)
