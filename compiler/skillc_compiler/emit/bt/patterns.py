"""Nodes of the language that BehaviorTree.CPP has not, out of nodes that it has."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.body import after, holding
from skillc_compiler.emit.bt.ports import INT_MAX

NOT_YET, WORKED, FAILED = 0, 1, 2


def until(condition: Element) -> Element:
    """Run until the condition succeeds."""
    failing = holding(Element("KeepRunningUntilFailure"), inverted(condition))
    return inverted(failing)


def inverted(child: Element) -> Element:
    """Exchange success and failure."""
    return holding(Element("Inverter"), child)


def lead(first: Element, others: Sequence[Element]) -> Element:
    """Run the first child with the others beside it; these never finish, so the first decides and halts them."""
    endless = [sequence_of(holding(Element("ForceSuccess"), each), _endless()) for each in others]
    return holding(Element("Parallel", success_count="1", failure_count="1"), first, *endless)


def once(child: Element, entry: str) -> Element:
    """Run the child unless it has ended before; the entry remembers how and must be 0 when the skill starts."""
    guarded = holding(
        Element("Sequence", _onSuccess=f"{entry} := {WORKED}", _onFailure=f"{entry} := {FAILED}"),
        child,
    )
    return holding(Element("IfThenElse"), _is(entry, NOT_YET), guarded, _is(entry, WORKED))


def kept(child: Element, still: Sequence[Element], entry: str) -> Element:
    """Run the child unless it has worked before and the tests say that this still holds."""
    guarded = holding(Element("Sequence", _onSuccess=f"{entry} := {WORKED}"), child)
    tests = [_is(entry, WORKED), *still]
    return holding(Element("Fallback"), after(tests[:-1], tests[-1]), guarded)


def while_(condition: Element, child: Element, limit: int, done: str, rounds: str) -> Element:
    """Run the child again while the condition holds; the loop fails if it still holds after so many rounds.

    A round that finds the condition false fails too, which ends the loop; `done` tells this from a child that failed.
    """
    condition.set("_onFailure", f"{done} := {WORKED}")
    counted = Element("ScriptCondition", code=f"{rounds} < {limit}", _onSuccess=f"{rounds} := {rounds} + 1")
    loop = holding(Element("Repeat", num_cycles=count_text(limit + 1)), sequence_of(condition, counted, child))
    ended = holding(Element("Fallback"), loop, _is(done, WORKED))
    return sequence_of(Element("Script", code=forget([done, rounds])), ended)


def count_text(count: int) -> str:
    """Return a number of rounds as the library reads it, which knows no higher one."""
    return str(min(count, INT_MAX))


def sequence_of(*children: Element) -> Element:
    """Return the children in order."""
    return holding(Element("Sequence"), *children)


def forget(entries: Sequence[str]) -> str:
    """Return the script that forgets how things ended."""
    return "; ".join(f"{entry} := {NOT_YET}" for entry in entries)


def _endless() -> Element:
    return holding(Element("KeepRunningUntilFailure"), Element("AlwaysSuccess"))


def _is(entry: str, value: int) -> Element:
    return Element("ScriptCondition", code=f"{entry} == {value}")
