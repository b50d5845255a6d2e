"""Reads from the files of Fast Downward what it has found and proved so far."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import msgspec

from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.progress import PlanningProgress, ReportProgress

COST = re.compile(r"^; cost = (\d+)", re.MULTILINE)
"""The cost of a plan in its file, in units; it is the last line."""
_PROVED = re.compile(r"\bf = (\d+)")
_EVALUATED = re.compile(r"\b(\d+) evaluated")


def read_lower_bound(output: str) -> int:
    """Return the lower bound on the cost of any plan that A* proved by its output, in units."""
    return max(map(int, _PROVED.findall(output)), default=0)


class SearchWatch(msgspec.Struct, frozen=True):
    """Reports how far the programs are that work in a folder."""

    planner: str
    problem: Problem
    folder: Path
    report: ReportProgress

    def look(self) -> None:
        """Report the best plan, the best lower bound, and how many states A* has evaluated."""
        outputs = [each.read_text("utf-8", "replace") for each in self.folder.glob("proving*.txt")]
        best, scale = min(self._read_costs(), default=None), float(self.problem.domain.scale)
        self.report(
            PlanningProgress(
                planner=self.planner,
                best_s=None if best is None else best / scale,
                at_least_s=max(map(read_lower_bound, outputs), default=0) / scale,
                states=sum(max(map(int, _EVALUATED.findall(each)), default=0) for each in outputs),
            )
        )

    def _read_costs(self) -> Iterator[int]:
        for each in self.folder.glob("found*"):
            if (stated := COST.search(each.read_text("utf-8", "replace"))) is not None:
                yield int(stated.group(1))
