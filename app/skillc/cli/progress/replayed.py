"""Shows a recorded run in the terminal like a run that goes on, with keys that pause and step what is shown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from skillc.cli.progress.run_progress import LOOK_S, RunProgress
from skillc.cli.progress.run_view import EventView, RunView
from skillc.services.replaying.playback import Playback
from skillc_runtime.execution.pace import Pace
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.envelope import Envelope

PLAYING = ("pause", "stop")
PAUSED = ("resume", "step-into", "stop")
"""The names of the commands that a replay allows."""


def play(title: str, events: Sequence[Envelope], pace: Pace) -> None:
    """Show a recorded run until its end, or until its user stops. KeyboardInterrupt if a signal comes."""
    with RunProgress(title, False, pace) as progress, progress.operating():
        player = _Player(Playback(events), progress)
        while not player.ended:
            player.tick()
            if progress.interrupted:
                raise KeyboardInterrupt


class _Player:
    """A recorded run that is shown."""

    def __init__(self, playback: Playback, progress: RunProgress) -> None:
        self._playback, self._progress = playback, progress
        self._view = EventView()
        self._paused = self._stopped = False

    @property
    def ended(self) -> bool:
        """Whether nothing is left to show, or the user has seen enough."""
        return self._stopped or self._playback.ended

    def tick(self) -> None:
        """Show what is due, and do what the keys say."""
        now = self._playback.now
        remaining_s = self._progress.pace.remaining_s(now, standing=self._paused)
        wait_s = LOOK_S if self._paused else min(remaining_s, LOOK_S)
        for command in self._progress.take_commands(self._look, now, wait_s):
            self._obey(command)
        if not self._paused and not self._stopped and wait_s < LOOK_S:
            self._show(self._playback.advance())

    def _obey(self, command: Command) -> None:
        if command.name not in self._allowed:
            return
        match command:
            case commands.StepInto():
                self._show(self._playback.step())
            case commands.Stop():
                self._stopped = True
            case _:
                self._paused = isinstance(command, commands.PauseRun)

    def _show(self, events: Iterable[Envelope]) -> None:
        for each in events:
            self._view.observe(each.event)
            self._progress(each.event)

    @property
    def _allowed(self) -> tuple[str, ...]:
        return PAUSED if self._paused else PLAYING

    def _look(self) -> RunView:
        """Return what the run did then; while the replay pauses, that it does."""
        playback = self._playback
        if self._paused:
            return RunView("paused", "the replay pauses", self._allowed, self._view.stacks)
        return RunView(playback.state, playback.reason, self._allowed, self._view.stacks, playback.contact)
