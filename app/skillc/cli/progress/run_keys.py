"""The keys with which a user operates a run, and what they do in each state."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc.cli.progress.run_view import RunView
from skillc_runtime.execution.pace import Pace, format_pace
from skillc_runtime.recording.commands import AnswerPrompt, Command, PauseRun, Resume, StepInto, StepOut, StepOver, Stop

ENTER = "\n"


class Key(msgspec.Struct, frozen=True):
    """A key, what it does in a word or two, and the command that it gives."""

    letter: str
    label: str
    command: Command

    @property
    def shown(self) -> str:
        """What is written on the key."""
        return "Enter" if self.letter == ENTER else self.letter


KEYS = (
    Key("p", "pause", PauseRun()),
    Key("s", "step over", StepOver()),
    Key("i", "step into", StepInto()),
    Key("o", "step out", StepOut()),
    Key("c", "continue", Resume()),
    Key("q", "stop", Stop("stopped by the user")),
)
CONFIRMING_KEYS = (
    Key(ENTER, "go on", Resume()),
    Key("s", "stop", Stop("stopped by the user")),
    Key("p", "pause", PauseRun()),
)
"""The keys of a run whose user confirms each step. `s` stops it there, and does not step: nothing moves by mistake."""
FASTER, SLOWER = "+", "-"
DETACH = "d"


def keys_of(run: RunView) -> tuple[Key, ...]:
    """Return the keys that a run has."""
    return CONFIRMING_KEYS if run.confirms else KEYS


def format_help(run: RunView, pace: Pace, detachable: bool) -> str:
    """Return the line that says which keys do something now."""
    detach = [f"{DETACH} detach"] if detachable else []
    paces = [] if pace.is_fixed else [f"{FASTER} {SLOWER} pace: {format_pace(pace.factor)}"]
    return "  ".join((*_format_keys(run), *detach, *paces))


def find_answer(digit: str, run: RunView) -> AnswerPrompt | None:
    """Return the answer that a digit means: the choice of the first prompt with this number; None for no choice."""
    number = int(digit)
    if not run.prompts or not 0 < number <= len(run.prompts[0].choices):
        return None
    return AnswerPrompt(run.prompts[0].choices[number - 1], run.prompts[0].id, who="the user")


def explain_refusal(key: Key, run: RunView) -> str:
    """Say that a key does nothing now, and which ones do."""
    possible = ", ".join(_format_keys(run)) or "no key"
    return f"{key.shown} ({key.label}) is not possible while the task is {run.state}; possible: {possible}"


def _format_keys(run: RunView) -> Iterator[str]:
    return (f"{key.shown} {key.label}" for key in keys_of(run) if key.command.name in run.allowed)
