"""The keys with which a user operates a run, and what they do in each state."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc.cli.run_view import RunView
from skillc_runtime.execution.pace import Pace, format_pace
from skillc_runtime.recording.commands import Answer, Command, Pause, Resume, StepInto, StepOut, StepOver, Stop


@dataclass(frozen=True, slots=True)
class Key:
    """A key, what it does in a word or two, and the command that it gives."""

    letter: str
    label: str
    command: Command


KEYS = (
    Key("p", "pause", Pause()),
    Key("s", "step over", StepOver()),
    Key("i", "step into", StepInto()),
    Key("o", "step out", StepOut()),
    Key("c", "continue", Resume()),
    Key("q", "stop", Stop("stopped by the user")),
)
FASTER, SLOWER = "+", "-"
DETACH = "d"


def format_help(allowed: tuple[str, ...], pace: Pace, detachable: bool) -> str:
    """Return the line that says which keys do something now."""
    detach = [f"{DETACH} detach"] if detachable else []
    return "  ".join((*_format_keys(allowed), *detach, f"{FASTER} {SLOWER} pace: {format_pace(pace.factor)}"))


def find_answer(digit: str, run: RunView) -> Answer | None:
    """Return the answer that a digit means: the choice of the first prompt with this number; None for no choice."""
    number = int(digit)
    if not run.prompts or not 0 < number <= len(run.prompts[0].choices):
        return None
    return Answer(run.prompts[0].choices[number - 1], run.prompts[0].id, who="the user")


def explain_refusal(key: Key, run: RunView) -> str:
    """Say that a key does nothing now, and which ones do."""
    possible = ", ".join(_format_keys(run.allowed)) or "no key"
    return f"{key.letter} ({key.label}) is not possible while the task is {run.state}; possible: {possible}"


def _format_keys(allowed: tuple[str, ...]) -> Iterator[str]:
    return (f"{key.letter} {key.label}" for key in KEYS if key.command.name in allowed)
