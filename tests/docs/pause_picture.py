"""Draws the terminal of a wiping task that is paused in contact, for docs/pausing.md; as a program it writes it."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence

from rich.console import CONSOLE_SVG_FORMAT, Console
from rich.terminal_theme import DEFAULT_TERMINAL_THEME
from rich.text import Text

from docs.pages import ROOT
from operating.monitors import Monitor
from skillc.cli.progress.run_display import compose_display
from skillc.cli.progress.run_view import view_run
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command, PauseRun, Stop
from skillc_runtime.recording.events import StateChanged
from skillc_runtime.recording.run_spec import RunSpec

PICTURE = ROOT / "docs/pictures/paused.svg"
TASK, WIDTH, PRESSED_S, PAUSED_S = "clean_desk", 92, 16.0, 1.0
FONTS = re.compile(r"@font-face \{\{.*?\}\}", re.DOTALL)


def draw() -> str:
    """Pause the task while it wipes, and return the picture of its terminal."""
    lines: list[str] = []
    pressing_since: list[float] = []

    def pause_in_contact(run: TaskRun, now: float) -> Sequence[Command]:
        if run.state == "running" and run.tree is not None and run.tree.active.is_pressing:
            pressing_since.append(now)
            return (PauseRun(),) if now - pressing_since[0] > PRESSED_S else ()
        since = [event.time for event in monitor.events if isinstance(event, StateChanged)]
        if run.state == "paused" and now - since[-1] > PAUSED_S:
            lines[:] = compose_display(TASK, view_run(run), now, since[-1], Pace(), "")
            return (Stop(),)
        return ()

    monitor = Monitor(pause_in_contact)
    with load_task(RunSpec(task=TASK), SilentReporter()) as task:
        run_task(task, RunOptions(), monitor, SilentReporter())
    return render(lines)


def render(lines: Sequence[str]) -> str:
    """Return the picture of a terminal with these lines, without the fonts that it would load from elsewhere."""
    console = Console(record=True, width=WIDTH, file=io.StringIO(), legacy_windows=False)
    console.print(Text(f"⠼ {lines[0]}\n" + "\n".join(lines[1:])))
    return console.export_svg(
        title=f"skillc run {TASK}",
        unique_id="paused",
        theme=DEFAULT_TERMINAL_THEME,
        code_format=FONTS.sub("", CONSOLE_SVG_FORMAT),
    )


def read_text(svg: str) -> list[str]:
    """Return the text of a picture, line by line, with `0` for each number in it: times depend on the machine."""
    texts = re.findall(r"<text[^>]*>(.*?)</text>", svg)
    return [re.sub(r"\d+\.\d+", "0", text.replace("&#160;", " ")) for text in texts]


if __name__ == "__main__":
    PICTURE.parent.mkdir(exist_ok=True)
    PICTURE.write_text(draw(), encoding="utf-8")
