"""Runs `skillc run` in this process, and has the CPU time until its first tick of control and that of its report.

`python _command.py TASK` prints a line of JSON. It uses only what all commits have that are compared.
"""

from __future__ import annotations

import gc
import json
import sys
from collections.abc import Callable
from contextlib import redirect_stdout, suppress
from functools import partial
from importlib import import_module
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any


class FirstAdvance:
    """Notes when time passes in a cell for the first time, and what the report costs."""

    def __init__(self) -> None:
        self.start_s: float | None = None
        self.report_s = self.before_report_s = 0.0

    def advance(self, advance: Any, cell: Any, seconds: float) -> Any:
        """Let time pass in a cell, by its own function."""
        if self.start_s is None:
            self.start_s = process_time()
        return advance(cell, seconds)

    def report(self, report: Any, *arguments: Any) -> Any:
        """Make the report, by its own function."""
        began, self.before_report_s = process_time(), _all_processes_s()
        made = report(*arguments)
        self.report_s = process_time() - began
        return made


class AfterImport(MetaPathFinder):
    """Changes modules as soon as the command has imported them, when and in the order in which it does."""

    def __init__(self, changes: dict[str, Callable[[Any], None]]) -> None:
        self._changes = changes

    def find_spec(self, name: str, path: Any, target: Any = None) -> ModuleSpec | None:
        """Find a module to change by the other finders."""
        change = self._changes.pop(name, None)
        spec = None if change is None else find_spec(name)
        if spec is None or spec.loader is None or change is None:
            return None
        execute = spec.loader.exec_module

        def execute_and_change(module: Any) -> None:
            execute(module)
            change(module)

        spec.loader.exec_module = execute_and_change  # type: ignore[method-assign]
        return spec


def _all_processes_s() -> float:
    """Return the CPU time in s of this process, and of those that it has started and that have ended."""
    used = [getrusage(which) for which in (RUSAGE_SELF, RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def main(task: str) -> None:
    """Print the times in s: until the first tick, of the report, and of all that is made for it by any process."""
    entry, noted = import_module("skillc.cli.main"), FirstAdvance()
    gc.set_threshold(getattr(entry, "GARBAGE", gc.get_threshold()[0]))

    def note_advance(cells: Any) -> None:
        inner = cells.SimulatedCell.advance
        cells.SimulatedCell.advance = lambda cell, seconds: noted.advance(inner, cell, seconds)

    def note_report(running: Any) -> None:
        running.report_run = partial(noted.report, running.report_run)

    after = {"skillc_runtime.backends.mujoco.cell": note_advance, "skillc.services.run.running": note_report}
    sys.meta_path.insert(0, AfterImport(after))
    with TemporaryDirectory() as folder, redirect_stdout(sys.stderr), suppress(SystemExit):
        entry.skillc(["run", task, "--out", folder, "--no-film"])
    whole_s = _all_processes_s() - noted.before_report_s
    print(json.dumps({"start_s": noted.start_s, "report_s": noted.report_s, "figures_s": whole_s}))


if __name__ == "__main__":
    main(*sys.argv[1:])
