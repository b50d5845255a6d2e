"""The lines that show how a run stands: what it does, where it is paused and why, which keys do something."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.cli.run_estimate import Estimate
from skillc.cli.run_keys import format_help
from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.execution.tree.gate import Call
from skillc_runtime.execution.tree.run import TreeRun

MAX_CALLS = 12
"""How many calls of a stack are shown; the innermost ones."""


def compose_display(title: str, run: TaskRun, now: float, since: float, pace: Pace | None, remark: str) -> list[str]:
    """Return all lines for a run, as `describe_run` does, with the keys if there is a `pace` that they can change."""
    first, *more = describe_run(run, now, since)
    keys = [] if pace is None else [f"  {format_help(run.allowed, pace)}"]
    return [f"{title}  {first}", *more, *keys, *([f"  {remark}"] if remark else [])]


def describe_run(run: TaskRun, now: float, since: float) -> list[str]:
    """Return the lines for a run at the time `now` of the cell in s; it is in its state since `since`.

    While it runs, that is the stack of the last active call. While it pauses or is paused, the reason, what becomes
    of forces, and each stack with the places of its calls, the innermost first.
    """
    tree = run.tree
    match run.state:
        case "running" if tree is not None and not tree.paused:
            return [f"{now:6.1f} s  {_join_stack(tree)}"]
        case "running":
            return [f"{now:6.1f} s  the tool approaches again"]
        case "paused" | "pausing" if tree is not None:
            head = f"{now:6.1f} s  {run.state} since {since:.1f} s: {run.reason}"
            return [head, *_describe_forces(tree), *_describe_stacks(tree)]
        case _:
            return [f"{run.state}: {run.reason}" if run.reason else run.state]


def format_estimate(estimate: Estimate) -> str:
    """Return which step runs, how long the plan takes in the time of the cell, and how long the rest in wall time."""
    left = "" if estimate.left_s is None else f", {_format_duration(estimate.left_s)} left"
    return f"step {estimate.step} of {estimate.steps}, about {estimate.total_s:.0f} s{left}"


def _format_duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def _join_stack(tree: TreeRun) -> str:
    active = tree.active_calls
    return " > ".join(call.skill_name for call in reversed(_stack(active[-1]))) if active else ""


def _stack(call: Call) -> list[Call]:
    """Return a call and those around it, the innermost first."""
    return [call, *call.enclosing_calls()]


def _describe_forces(tree: TreeRun) -> Iterator[str]:
    """Say what became of the force of a tool that pressed; nothing if none did."""
    if not tree.is_pressing or not tree.paused:
        return
    if tree.withdrawn:
        yield "  the tool was taken off; it senses contact again before the task goes on"
    else:
        yield "  the force is kept"


def _describe_stacks(tree: TreeRun) -> Iterator[str]:
    for innermost in tree.active_calls:
        stack = _stack(innermost)
        width = max(len(call.skill_name) for call in stack)
        marks = ["next" if tree.holds_back(innermost) else "in", *("" for _ in stack)]
        for mark, call in zip(marks, stack[:MAX_CALLS], strict=False):
            yield f"  {mark:4}  {call.skill_name:{width}}  {call.source}"
        if len(stack) > MAX_CALLS:
            yield f"        and {len(stack) - MAX_CALLS} calls around them"
