"""Look at the devices of a scene, without moving them.

Shows the condition of each arm, and what is measured beside what the scene says.

Exit code 1 if a device is not ready or contradicts the scene, with --once and --json; 0 after Ctrl-C.
"""

from __future__ import annotations

import re
import sys
import time
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_scene
from skillc.cli.console import find_display_obstacle, page_of, print_json, print_lines, print_remark
from skillc.cli.options import BACKEND, PATH, json_option
from skillc.cli.progress.slow_notice import notice_if_slow

if TYPE_CHECKING:
    from skillc_runtime.devices.observed import CellObserver, ObservedCell

LOOK_S = 0.2
"""How often the devices are looked at, in s."""
SETTLE_S = 0.5
"""How long the devices are looked at with --once and --json, in s: long enough to see what moves."""
NUMBER = re.compile(r"[-+]?\d+(\.\d+)?")
EXAMPLES = """
skillc connect cell.ttl --backend ur
skillc connect cell.ttl --backend ros2 --once
skillc connect cell.ttl --backend ur --json
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("scene", type=PATH, shell_complete=complete_scene)
@click.option("--backend", type=BACKEND, required=True, help="The back end of the devices, such as `ur`.")
@click.option("--once", is_flag=True, help="Print the devices once, and end.")
@json_option
def command(scene: Path, backend: str, once: bool, as_json: bool) -> int:
    """Connect to the devices of SCENE and show what they report, until Ctrl-C. Nothing is moved or taken under control.

    On a terminal the display is kept up to date; elsewhere it is printed again when a condition or a remark changes.
    """
    from skillc.cli.console import Terminal
    from skillc.services.library.files import find_scene
    from skillc.services.run.connecting import connected_scene

    with ExitStack() as stack:
        with notice_if_slow("connecting to the devices .."):
            observer = stack.enter_context(connected_scene(find_scene(scene), backend, Terminal()))
        if not once and not as_json:
            _watch(observer)
            return 0
        seen = _settle(observer)
    if as_json:
        print_json({"cell": seen, "problems": seen.problems})
    else:
        _print(seen)
    return 1 if seen.problems else 0


def _settle(observer: CellObserver) -> ObservedCell:
    until = time.monotonic() + SETTLE_S
    seen = observer.observe()
    while time.monotonic() < until:
        time.sleep(LOOK_S / 2)
        seen = observer.observe()
    return seen


def _watch(observer: CellObserver) -> None:
    try:
        if find_display_obstacle() is None and sys.stdout.isatty():
            _show(observer)
        else:
            _print_changes(observer)
    except KeyboardInterrupt:
        print_remark("nothing was moved")


def _show(observer: CellObserver) -> None:
    """Show what the devices report, in place."""
    from rich.live import Live
    from rich.text import Text

    from skillc.cli.console import rich_console
    from skillc.cli.output.connection import format_cell

    page, console = page_of(sys.stderr), rich_console(sys.stderr)
    with Live(console=console, auto_refresh=False, transient=False) as live:
        while True:  # wait ends: with Ctrl-C
            lines = format_cell(observer.observe(), page)
            live.update(Text.from_ansi("\n".join([*lines, "", "Ctrl-C ends; nothing is moved"])), refresh=True)
            time.sleep(LOOK_S)


def _print_changes(observer: CellObserver) -> None:
    """Print what the devices report, again whenever a condition or a remark changes; new numbers are no change."""
    printed: list[str] | None = None
    while True:  # wait ends: with Ctrl-C
        seen = observer.observe()
        words = [*(each.condition for each in seen.arms), *(NUMBER.sub("", each) for each in seen.problems)]
        if words != printed:
            printed = words
            _print(seen)
        time.sleep(LOOK_S)


def _print(seen: ObservedCell) -> None:
    from skillc.cli.output.connection import format_cell

    print_lines([*format_cell(seen, page_of(sys.stdout)), ""])
    sys.stdout.flush()
    print_remark(
        "no task can begin before the problems are solved"
        if seen.problems
        else "the devices are ready, and nothing contradicts the scene"
    )
