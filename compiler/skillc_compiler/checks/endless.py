"""A skill that never ends by itself and that nothing halts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Call, Implementation, Skill, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_compiler.python.targets import NamedPython, Targets
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("never-ends", "not-endless")
NEEDS = Need.TYPES
READS = Reads.PYTHON


def check(of: NamedPython) -> Iterator[Diagnostic]:
    """Yield a problem for each body that cannot end, and each `endless` declaration that is wrong."""
    program, targets = of.program, of.targets
    for skill in program.skills.values():
        if "endless" in skill.flags:
            yield from _check_promises(skill)
    for implementation in program.implementations:
        endless = "endless" in implementation.skill.flags
        match implementation.body:
            case TypedNode() as body if endless:
                yield from _check_endless(implementation, body)
            case TypedNode() as body:
                yield from _check_ends(body)
            case s.RunPython() as target:
                yield from _check_python(implementation, target, endless, targets)
            case None:
                pass
            case _:
                assert_never(implementation.body)
    for task in program.tasks:
        if task.body is not None:
            yield from _check_ends(task.body)


def endless_calls(node: TypedNode) -> Iterator[Call]:
    """Yield the calls of endless skills in a node that nothing in it halts."""
    match node.written:
        case s.Decorator(kind="timeout"):
            return
        case s.Block(kind="par lead"):
            yield from endless_calls(node.children[0]) if node.children else ()
        case s.Block(kind="par race" | "par any"):
            each = [tuple(endless_calls(child)) for child in node.children]
            yield from (call for calls in each for call in calls if all(each))
        case s.Block(kind="reactive seq" | "reactive sel"):
            for number, child in enumerate(node.children):
                if not any(_may_change(earlier) for earlier in node.children[:number]):
                    yield from endless_calls(child)
        case _:
            if node.call and node.call.skill and "endless" in node.call.skill.flags:
                yield node.call
            for child in (*node.children, *node.orelse):
                yield from endless_calls(child)


def _may_change(node: TypedNode) -> bool:
    """Whether a node that has ended may end differently when it is evaluated again."""
    for each in nodes_in(node):
        if each.conditions:
            return True
        if each.call and each.call.skill and any(r.says_what_comes for r in each.call.skill.requirements):
            return True
    return False


def _check_ends(body: TypedNode) -> Iterator[Diagnostic]:
    call = next(endless_calls(body), None)
    if call is not None and call.skill is not None:
        yield Diagnostic(
            "never-ends",
            call.written.skill.span,
            f"`{call.skill.name}` never ends by itself, and nothing here halts it",
            help="run it in a `par lead { .. }`, after the child that it accompanies, or in a `timeout`",
            labels=(Label(call.skill.name_span, "declared `endless`"),),
        )


def _check_endless(implementation: Implementation, body: TypedNode) -> Iterator[Diagnostic]:
    if next(endless_calls(body), None) is None:
        skill = implementation.skill
        yield Diagnostic(
            "not-endless",
            implementation.name_span,
            f"`{skill.name}` is declared `endless`, but `{implementation.name}` ends",
            help="let it end with a call of an endless skill, or remove the flag `endless`",
            labels=(Label(skill.name_span, "declared here"),),
        )


def _check_promises(skill: Skill) -> Iterator[Diagnostic]:
    """Report posts, outputs and the flag `scoped` of an endless skill, as they have no effect."""
    help_ = "remove it, or the flag `endless`"
    for post in (r for r in skill.requirements if r.says_what_comes):
        message = f"`{skill.name}` is `endless`, so this is never reached"
        yield Diagnostic("not-endless", post.span, message, help_)
    for parameter in (p for p in skill.parameters if p.direction == "out"):
        message = f"`{skill.name}` is `endless`, so this output never gets a value"
        yield Diagnostic("not-endless", parameter.span, message, help_)
    if "scoped" in skill.flags:
        message = f"`{skill.name}` is `endless`, so the block of a `with` never begins"
        yield Diagnostic("not-endless", skill.name_span, message, "remove one of the flags `endless` and `scoped`")


def _check_python(
    implementation: Implementation, written: s.RunPython, endless: bool, targets: Targets
) -> Iterator[Diagnostic]:
    module, _, name = written.target.value.partition(":")
    found = targets.method_returns(module, name, "tick")
    label = (Label(implementation.skill.name_span, "the skill"),)
    if found == {"RUNNING"} and not endless:
        message = f"`{name}` never ends by itself: its `tick` returns nothing but `RUNNING`"
        help_ = f"declare `{implementation.skill.name}` `endless`, so that callers are checked"
        yield Diagnostic("never-ends", written.target.span, message, help_, "warning", label)
    if "SUCCESS" in found and endless:
        message = (
            f"`{implementation.skill.name}` is declared `endless`, and the `tick` of `{name}` may return `SUCCESS`"
        )
        help_ = "return nothing but `RUNNING`, or remove the flag `endless`"
        yield Diagnostic("not-endless", written.target.span, message, help_, "warning", label)
