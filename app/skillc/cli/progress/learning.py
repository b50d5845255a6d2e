"""Shows the progress of learning on stderr: a bar with the best values so far, plain lines elsewhere."""

from __future__ import annotations

from rich.progress import TextColumn
from rich.table import Column

from skillc.cli.progress.stderr import StderrProgress
from skillc.contract.learning import LearnSpec
from skillc.services.learning.coordinator import Progress as LearningState

MOST_SHOWN = 3
"""How many members of the front are shown."""


class LearningProgress(StderrProgress):
    """Shows how many candidates are done, and the front so far: a bar on a terminal, a line for each elsewhere.

    Nothing if `quiet`.
    """

    def __init__(self, task: str, spec: LearnSpec, quiet: bool) -> None:
        front = TextColumn("{task.fields[front]}", markup=False, table_column=Column(no_wrap=True, overflow="ellipsis"))
        super().__init__(task, spec.candidates, 0, quiet, front, front="")
        self._done, self._fresh = 0, 0

    def __call__(self, state: LearningState) -> None:
        """Show a state."""
        front = _format_front(state)
        self._bar.update(self._row, completed=state.done, front=front)
        if self._prints_lines:
            if state.done > self._done:
                where = f"{state.done} of {state.wanted} candidates, {state.trials} trials"
                self._console.print(f"{where}: {front}", soft_wrap=True)
            elif state.fresh > self._fresh:
                self._console.print(f"{state.fresh} trials with fresh seeds", soft_wrap=True)
        self._done, self._fresh = state.done, state.fresh


def _format_front(state: LearningState) -> str:
    """Return the objectives of the front so far, and those of the defaults."""
    defaults = "" if state.defaults is None else f"defaults {_format_values(state.defaults)}"
    if not state.front:
        return f"{defaults}; no candidate meets all constraints yet".removeprefix("; ")
    shown = ", ".join(_format_values(values) for values in state.front[:MOST_SHOWN])
    more = f" and {len(state.front) - MOST_SHOWN} more" if len(state.front) > MOST_SHOWN else ""
    return f"front {shown}{more}; {defaults}".removesuffix("; ")


def _format_values(values: tuple[float, ...]) -> str:
    return " / ".join(f"{value:.3g}" for value in values)
