"""The lines that show how a run stands: what it does, where it is paused and why, which keys do something."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.cli.progress.run_estimate import Estimate
from skillc.cli.progress.run_keys import format_help
from skillc.cli.progress.run_view import RunView
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.execution.pace import Pace
from skillc_runtime.recording.contact import SENTENCES

MAX_CALLS = 12
"""How many calls of a stack are shown; the innermost ones."""


def compose_display(
    title: str, run: RunView, now: float, since: float, pace: Pace | None, remark: str, detachable: bool = False
) -> list[str]:
    """Return all lines for a run, as `describe_run` does, with the keys if there is a `pace` that they can change."""
    first, *more = describe_run(run, now, since)
    keys = [] if pace is None else [f"  {format_help(run, pace, detachable)}"]
    asked = [f"  {format_prompt(run.prompts[0], now)}"] if run.prompts else []
    return [f"{title}  {first}", *more, *asked, *keys, *([f"  {remark}"] if remark else [])]


def describe_run(run: RunView, now: float, since: float) -> list[str]:
    """Return the lines for a run at the time `now` of the cell in s; it is in its state since `since`.

    While it runs, that is the stack of the last active call. While it pauses or is paused, the reason, what becomes
    of a tool that pressed, and each stack with the places of its calls, the innermost first.
    """
    match run.state:
        case "running" if run.contact != "none":
            return [f"{now:6.1f} s  {SENTENCES[run.contact]}"]
        case "running":
            return [f"{now:6.1f} s  {_join_stack(run)}"]
        case "paused" | "pausing":
            head = f"{now:6.1f} s  {run.state} since {since:.1f} s: {run.reason}"
            contact = [f"  {SENTENCES[run.contact]}"] if run.contact != "none" else []
            return [head, *contact, *_describe_stacks(run)]
        case _:
            return [f"{run.state}: {run.reason}" if run.reason else run.state]


def format_prompt(prompt: Prompt, now: float) -> str:
    """Return what an operator is asked at the time `now` of the cell in s, with the key of each choice."""
    choices = "  ".join(f"{number} {each}" for number, each in enumerate(prompt.choices, 1))
    left = _format_duration(max(0.0, prompt.ends_s - now))
    return f"{prompt.text}  {choices}  ({prompt.default or 'fails'} after {left})"


def format_estimate(estimate: Estimate) -> str:
    """Return which step runs, how long the plan takes in the time of the cell, and how long the rest in wall time."""
    left = "" if estimate.left_s is None else f", {_format_duration(estimate.left_s)} left"
    return f"step {estimate.step} of {estimate.steps}, about {estimate.total_s:.0f} s{left}"


def _format_duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def _join_stack(run: RunView) -> str:
    return " > ".join(call.skill for call in reversed(run.stacks[-1].calls)) if run.stacks else ""


def _describe_stacks(run: RunView) -> Iterator[str]:
    for stack in run.stacks:
        width = max(len(call.skill) for call in stack.calls)
        marks = ["next" if stack.next else "in", *("" for _ in stack.calls)]
        for mark, call in zip(marks, stack.calls[:MAX_CALLS], strict=False):
            yield f"  {mark:4}  {call.skill:{width}}  {call.source}"
        if len(stack.calls) > MAX_CALLS:
            yield f"        and {len(stack.calls) - MAX_CALLS} calls around them"
