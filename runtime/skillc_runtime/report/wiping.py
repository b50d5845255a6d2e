"""Finds the wiping in a run and judges it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from skillc_runtime.report.result import WipingResult
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.metrics import Wiped, wiping_metrics
from skillc_runtime.trace.events import ImplementationChosen
from skillc_runtime.trace.outcome import Outcome
from skillc_runtime.world.frames import size

NORMAL_FORCE = "https://w3id.org/skillc/wiping#normalForce"
PATH_SKILL = "FollowPath"


@dataclass(frozen=True, slots=True)
class Wiping:
    """A tool followed a path on a surface from `start` to `end`, in a skill that `began` before; IRIs, s."""

    surface: str
    tool: str
    began: float
    start: float
    end: float


def find_wiping(tree: Outcome, choices: Mapping[int, ImplementationChosen], cell: SimulatedCell) -> Wiping | None:
    """Return the last call with a surface and a tool below which a path was followed to its end; None without one."""
    expand = cell.world.snapshot().vocabulary.expand
    found: Wiping | None = None
    for node in _nodes(tree):
        bindings = choices[node.id].bindings if node.id in choices else {}
        if "surface" not in bindings or "tool" not in bindings:
            continue
        for start, end in _paths(node, choices):
            found = Wiping(expand(bindings["surface"]), expand(bindings["tool"]), node.started or 0.0, start, end)
    return found


def described(wiping: Wiping, cell: SimulatedCell) -> Wiped:
    """Return what was wiped with what, as it really was."""
    state = cell.world.snapshot()
    surface = next(each for each in cell.facts.surfaces if each.individual == wiping.surface)
    force = state.value(wiping.surface, NORMAL_FORCE)
    return Wiped(
        surface=cell.true_pose(surface),
        extent=surface.size[:2],
        tool=size(state, wiping.tool)[:2],
        force_command_n=float(force) if isinstance(force, int | float) else 0.0,
    )


def judge(wiping: Wiping, cell: SimulatedCell) -> WipingResult:
    """Measure how good the wiping was."""
    recording = cell.recording(wiping.tool).between(wiping.began, wiping.end)
    metrics = wiping_metrics(recording, wiping.start, wiping.end, described(wiping, cell))
    return WipingResult(
        coverage=metrics.coverage,
        force_command_n=metrics.force_command_n,
        force_mean_n=metrics.force_mean_n,
        force_rmse_n=metrics.force_rmse_n,
        contact_lost=metrics.contact_lost,
        vibration_mm_s=metrics.vibration_mm_s,
        tilt_rms_deg=metrics.tilt_rms_deg,
        first_impact_n=metrics.first_impact_n,
        lane_dwell_s=metrics.lane_dwell_s,
    )


def _paths(node: Outcome, choices: Mapping[int, ImplementationChosen]) -> Iterator[tuple[float, float]]:
    """Yield when each path below a node that was followed to its end began and ended."""
    for each in _nodes(node):
        choice = choices.get(each.id)
        followed = choice is not None and choice.skill == PATH_SKILL and each.status == "success"
        if followed and each.started is not None and each.ended is not None:
            yield each.started, each.ended


def _nodes(node: Outcome) -> Iterator[Outcome]:
    yield node
    for child in node.children:
        yield from _nodes(child)
