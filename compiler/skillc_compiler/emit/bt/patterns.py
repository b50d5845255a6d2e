"""Nodes of the language that BehaviorTree.CPP does not have, composed of its built-in nodes."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.body import run_after, with_children
from skillc_compiler.emit.bt.ports import INT_MAX
from skillc_model.tree import MOST_ROUNDS

NOT_YET, WORKED, FAILED = 0, 1, 2


def run_until(condition: Element) -> Element:
    """Run until the condition succeeds."""
    failing = with_children(Element("KeepRunningUntilFailure"), invert(condition))
    return invert(failing)


def invert(child: Element) -> Element:
    """Exchange success and failure."""
    return with_children(Element("Inverter"), child)


def run_lead(first: Element, others: Sequence[Element]) -> Element:
    """Run the first child in parallel with the others, which never finish, so that the first decides and halts them."""
    endless = [make_sequence(with_children(Element("ForceSuccess"), each), _endless()) for each in others]
    return with_children(Element("Parallel", success_count="1", failure_count="1"), first, *endless)


def run_once(child: Element, entry: str) -> Element:
    """Run the child unless it has ended before; the entry stores the result and must be 0 when the skill starts."""
    guarded = with_children(
        Element("Sequence", _onSuccess=f"{entry} := {WORKED}", _onFailure=f"{entry} := {FAILED}"),
        child,
    )
    return with_children(Element("IfThenElse"), _is(entry, NOT_YET), guarded, _is(entry, WORKED))


def keep_result(child: Element, still: Sequence[Element], entry: str) -> Element:
    """Run the child unless it has succeeded before and the tests in `still` succeed."""
    guarded = with_children(Element("Sequence", _onSuccess=f"{entry} := {WORKED}"), child)
    tests = [_is(entry, WORKED), *still]
    return with_children(Element("Fallback"), run_after(tests[:-1], tests[-1]), guarded)


def run_finally(block: Element, last: Element, entry: str, source: str) -> Element:
    """Run `last` once the block has ended; the entry stores whether the block has succeeded, which is the result."""
    marked = with_children(Element("Sequence", _onSuccess=f"{entry} := {WORKED}"), block)
    ended = [with_children(Element("ForceSuccess"), each) for each in (marked, last)]
    start = Element("Script", code=reset_script([entry]))
    return with_children(Element("Sequence", _description=source), start, *ended, _is(entry, WORKED))


def run_while(condition: Element, child: Element, limit: int | str, done: str, rounds: str) -> Element:
    """Repeat the child while the condition holds; the loop fails if it still holds after `limit` rounds.

    A `limit` that is computed is the entry with it, in braces. A round also fails when the condition is false, which
    ends the loop; `done` distinguishes this from a failed child.
    """
    condition.set("_onFailure", f"{done} := {WORKED}")
    most = str(limit).strip("{}")
    counted = Element("ScriptCondition", code=f"{rounds} < {most}", _onSuccess=f"{rounds} := {rounds} + 1")
    cycles = format_rounds((limit if isinstance(limit, int) else MOST_ROUNDS) + 1)
    loop = with_children(Element("Repeat", num_cycles=cycles), make_sequence(condition, counted, child))
    ended = with_children(Element("Fallback"), loop, _is(done, WORKED))
    return make_sequence(Element("Script", code=reset_script([done, rounds])), ended)


def format_rounds(count: int) -> str:
    """Return a number of rounds as text, at most the highest `int` that BehaviorTree.CPP can read."""
    return str(min(count, INT_MAX))


def make_sequence(*children: Element) -> Element:
    """Return a sequence of the children."""
    return with_children(Element("Sequence"), *children)


def reset_script(entries: Sequence[str]) -> str:
    """Return the script that resets the stored results."""
    return "; ".join(f"{entry} := {NOT_YET}" for entry in entries)


def _endless() -> Element:
    return with_children(Element("KeepRunningUntilFailure"), Element("AlwaysSuccess"))


def _is(entry: str, value: int) -> Element:
    return Element("ScriptCondition", code=f"{entry} == {value}")
