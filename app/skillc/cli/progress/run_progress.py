"""Shows a run on stderr, and takes the keys and signals of its user: a live display on a terminal, else plain lines."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING

from skillc.cli.console import find_display_obstacle, page_of, print_talk
from skillc.cli.interrupts import Interrupted, noting_signals
from skillc.cli.layout import Style
from skillc.cli.progress.run_display import compose_display, format_prompt
from skillc.cli.progress.run_estimate import EndedStep, PlanProgress
from skillc.cli.progress.run_keys import DETACH, FASTER, SLOWER, explain_refusal, find_answer, keys_of
from skillc.cli.progress.run_view import RunView, view_run
from skillc.cli.settings import output_settings
from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.platforms.keyboard import Keys, is_operable, open_keyboard
from skillc_runtime.recording.commands import Command, Stop
from skillc_runtime.recording.events import (
    Event,
    NodeEnded,
    NodeStarted,
    PlanMade,
    PromptsChanged,
    Replanned,
    StateChanged,
    TaskEnded,
)
from skillc_runtime.recording.known_facts import format_status
from skillc_runtime.recording.states import State

if TYPE_CHECKING:
    from skillc.cli.progress.live_display import LiveDisplay

STEP_DEPTH = 2
"""The greatest depth of calls shown if stderr is not a terminal: the steps of a plan and the calls in them."""

LOOK_S = 0.04
"""How often keys are read and the display is changed, in s of wall time."""

SHOW_CURSOR, HIDE_CURSOR = b"\x1b[?25h", b"\x1b[?25l"


class RunProgress:
    """The monitor of a run: shows its state and active skills, and passes on keys and signals."""

    def __init__(self, title: str, quiet: bool, pace: Pace | None = None, detachable: bool = False) -> None:
        """Show nothing and take no keys if `quiet`; a key gives a run up that is `detachable`."""
        self.pace = pace or Pace()
        self._page = page_of(sys.stderr)
        self._title, self._quiet = title, quiet or output_settings().quiet
        self._calls: dict[int, tuple[str, ...]] = {0: ()}
        self._plan = PlanProgress()
        self._live: LiveDisplay | None = None
        self._keyboard: Keys | None = None
        self._signal: Callable[[], Interrupted | None] = lambda: None
        self._remark, self._since, self._looked = "", 0.0, 0.0
        self._stopped, self._detachable = False, detachable
        self._state: State = "queued"
        self.detached = False

    def __enter__(self) -> RunProgress:
        if not self._quiet and find_display_obstacle() is None:
            # What draws on a terminal is slow to import.
            from skillc.cli.progress.live_display import LiveDisplay

            self._live = LiveDisplay()
        return self

    def __exit__(self, *_: object) -> None:
        if self._live is not None:
            self._live.stop()

    def say(self, message: str) -> None:
        """Show a message."""
        if self._live is not None:
            self._live.show(f"{self._title}: {message}")
        else:
            self._print(f"{self._title}: {message}")

    def __call__(self, event: Event, ago_s: float = 0.0) -> None:
        """Show an event that happened `ago_s` s of wall time ago."""
        ended = self._plan.observe(event, time.monotonic() - ago_s)
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind, name=name) if self._live is None:
                around = self._calls.get(parent, ())
                self._calls[node] = (*around, name) if kind == "call" else around
                if kind == "call":
                    self._print_stack(event.time, self._calls[node])
            case NodeEnded(node=node):
                self._calls.pop(node, None)
                if ended is not None and self._live is not None:
                    self._print_step(ended)
            case StateChanged(state=state, reason=reason):
                self._since = self._since if state == self._state else event.time
                self._state = state
                self._print_reason(state, reason)
            case Replanned(reason=reason, sensed=sensed):
                text = f"{self._title}: {'goes on' if sensed else 'planning again'}: {reason}"
                self._print(text, "" if sensed else "warning")
            case PlanMade(steps=steps) as plan:
                calls = " -> ".join(step.skill for step in steps)
                self._print(f"{self._title}: {calls} ({plan.summary})")
            case PromptsChanged(prompts=prompts) if self._live is None:
                for each in prompts:
                    self._print(f"{self._title}: asks: {format_prompt(each, event.time)}")
            case TaskEnded(status=status, verified=verified, false_claims=claims):
                self.say(format_status(status, verified, claims))
            case _:
                pass

    def _print_reason(self, state: State, reason: str) -> None:
        """Print why a run stops, and for what one that goes on waits."""
        if state == "stopping":
            self._print(f"{self._title}: stopping: {reason}")
        elif state == "running" and reason:
            self._print(f"{self._title}: {reason}")

    @contextmanager
    def operating(self) -> Iterator[None]:
        """Take keys and signals, in a `with` statement; the second signal raises KeyboardInterrupt."""
        operable = self._live is not None and is_operable()
        keyboard = open_keyboard(self._suspended, self._continued) if operable else nullcontext()
        with noting_signals() as self._signal, keyboard as self._keyboard:
            try:
                yield
            finally:
                self._keyboard = None

    def attend(self, run: TaskRun, now: float, seconds: float) -> Sequence[Command]:
        """Show a run at the time `now` of the cell in s; wait for up to `seconds` of wall time for commands."""
        signal = self._signal()
        if signal is not None and not self._stopped:
            self._stopped = True
            return (Stop(str(signal)),)
        return self.take_commands(lambda: view_run(run), now, seconds)

    @property
    def interrupted(self) -> bool:
        """Whether a signal asks the program to end."""
        return self._signal() is not None

    def remark(self, text: str) -> None:
        """Show a remark until the next key."""
        self._remark = text

    def take_commands(self, look: Callable[[], RunView], now: float, seconds: float) -> Sequence[Command]:
        """Show a run at the time `now` of the cell in s, and wait for up to `seconds` of wall time for keys."""
        wall = time.monotonic()
        if seconds == 0.0 and wall - self._looked < LOOK_S:
            return ()
        self._looked = wall
        run = look()
        if self._live is not None:
            pace = self.pace if self._keyboard is not None else None
            first, *more = compose_display(self._title, run, now, self._since, pace, self._remark, self._detachable)
            self._live.show(first, *self._wrapped(more), estimate=self._plan.estimate(now, wall))
        if self._keyboard is None:
            time.sleep(seconds)
            return ()
        return [command for letter in self._keyboard.read(seconds) for command in self._understand(letter.lower(), run)]

    def _understand(self, letter: str, run: RunView) -> Iterator[Command]:
        """Yield the command of a key, also one that will be refused: that is recorded, and the user is told."""
        self._remark = ""
        if letter in (FASTER, SLOWER) and not self.pace.is_fixed:
            self.pace.faster() if letter == FASTER else self.pace.slower()
        self.detached |= self._detachable and letter == DETACH
        if letter.isdecimal() and (answer := find_answer(letter, run)) is not None:
            yield answer
        for key in keys_of(run):
            if key.letter == letter:
                if key.command.name not in run.allowed:
                    self._remark = explain_refusal(key, run)
                yield key.command

    def _wrapped(self, lines: Sequence[str]) -> Iterator[str]:
        """Yield the lines below the first one of the display, with a hanging indent where they are too wide."""
        for line in lines:
            margin = " " * (len(line) - len(line.lstrip()))
            yield from self._page.wrap(line.lstrip(), indent=margin, hanging=f"{margin}  ")

    def _print(self, text: str, style: Style = "") -> None:
        """Print a line that remains, above the display if there is one."""
        if not self._quiet:
            print_talk(*self._page.wrap(text, style, hanging="  "))

    def _print_step(self, ended: EndedStep) -> None:
        failed = ended.status == "failure"
        why = f": {ended.reason}" if failed and ended.reason else ""
        words = {"success": "succeeded", "failure": "failed"}.get(ended.status, ended.status)
        self._print(f"{ended.at_s:6.1f} s  {ended.skill} {words}{why}", "bad" if failed else "")

    def _print_stack(self, now: float, calls: tuple[str, ...]) -> None:
        if len(calls) <= STEP_DEPTH:
            self._print(f"{self._title}  {now:6.1f} s  {' > '.join(calls)}")

    def _suspended(self) -> None:
        os.write(sys.stderr.fileno(), SHOW_CURSOR + b"\n")

    def _continued(self) -> None:
        os.write(sys.stderr.fileno(), HIDE_CURSOR)
