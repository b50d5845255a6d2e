"""The figures that a report draws of each kind of work; `work.py` has the kinds, and what each measures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from skillc_runtime.evaluation.report.contact_figures import draw_push, draw_search, draw_wipings
from skillc_runtime.evaluation.report.dirt_figure import draw_maps, find_maps
from skillc_runtime.evaluation.report.figure import WorkFigure
from skillc_runtime.evaluation.report.guidances import find_free_periods
from skillc_runtime.evaluation.report.handling_drawing import choose_axes, make_handling_drawings
from skillc_runtime.evaluation.report.handling_figures import draw_grips, draw_path
from skillc_runtime.evaluation.report.motion_figures import draw_drive, draw_guidance, list_outlines
from skillc_runtime.evaluation.report.pushes import PushRecord, make_push_drawing
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.searches import find_searches, make_search_drawing
from skillc_runtime.evaluation.report.wiping import WipingDrawing
from skillc_runtime.evaluation.report.work import find_drives, find_other_pushes
from skillc_runtime.world.state.labels.labelled import display_name

MOST_FIGURES = 8
"""At most so many figures of one kind are drawn; the numbers of all work are in the result."""


def list_figures(record: RunRecord) -> tuple[WorkFigure, ...]:
    """Return the figures of all work in a run."""
    return tuple(figure for find in FIGURES for figure in _take(find(record)))


def make_wiping_figure(drawings: Sequence[WipingDrawing]) -> WorkFigure:
    """Return the figure of wipings, of one run or of several."""
    overlaid = any(each.overlay_period_s is not None for each in drawings)
    return WorkFigure(
        "wiping",
        "Path, contact time, speed and force on the surface",
        "The shade of a cell is how long it lay under the pressed tool." + (SWINGING if overlaid else ""),
        "Path of the tool over the contact time of each cell, speed along the lanes, normal force",
        partial(draw_wipings, drawings),
    )


def _take(figures: Iterator[WorkFigure]) -> Iterator[WorkFigure]:
    yield from (figure for _, figure in zip(range(MOST_FIGURES), figures, strict=False))


def _find_wipings(record: RunRecord) -> Iterator[WorkFigure]:
    if record.wiping_drawings:
        yield make_wiping_figure(record.wiping_drawings)


def _find_dirt(record: RunRecord) -> Iterator[WorkFigure]:
    if maps := find_maps(record):
        yield WorkFigure(
            "dirt",
            "What inspections have found",
            "A cell is the paler, the less certain it is. How each map is known is above it: sensed of an image or by "
            "touch, idealised of the map of a simulator.",
            "Maps of the clean and dirty cells of surfaces, one for each inspection",
            partial(draw_maps, maps),
        )


def _find_pushes(record: RunRecord) -> Iterator[WorkFigure]:
    """Yield the figures of pushes besides those in which something was searched for, which have another one."""
    searching = {(each.push.arm, each.push.start_s) for each in find_searches(record)}
    for push in (each for each in find_other_pushes(record) if (each.arm, each.start_s) not in searching):
        drawing = make_push_drawing(push, record)
        yield WorkFigure(
            "push",
            f"Force of {_describe(push)}",
            "Forces against the push. The arm measures or estimates them; its travel follows from its joints.",
            "Force of the tool over time and over its travel",
            partial(draw_push, drawing),
        )


def _find_searches(record: RunRecord) -> Iterator[WorkFigure]:
    for search in find_searches(record):
        drawing = make_search_drawing(search, record)
        yield WorkFigure(
            "search",
            f"Search of {_describe(search.push)}",
            "The path is to scale, seen against the push.",
            "Path of the tool while it searched, force and depth over time",
            partial(draw_search, drawing),
        )


def _find_guidances(record: RunRecord) -> Iterator[WorkFigure]:
    for period in find_free_periods(record):
        yield WorkFigure(
            "guidance",
            f"{display_name(period.arm)} guided by hand",
            "While the arm yields in all directions, whoever leads its tool decides where it goes.",
            "Path of the tool from above and from the side, force of the person, speed",
            partial(draw_guidance, period),
        )


def _find_handlings(record: RunRecord) -> Iterator[WorkFigure]:
    if record.truth is None:
        return
    drawings = make_handling_drawings(record.handlings, record.trace.hands, record.state, record.truth)
    across = choose_axes(drawings)
    for drawing in drawings:
        yield WorkFigure(
            "path",
            f"Path of {drawing.hand}",
            "A dashed outline is where a thing was believed to be, if that is more than 5 mm off.",
            "Path of the hand from above and from the side, and the things it moved",
            partial(draw_path, drawing, across),
        )
        yield WorkFigure(
            "grips",
            f"Grip of {drawing.hand}",
            "Skills see only what the sensor of the fingers measures. A gripper has no sensor of force: the force is "
            "that of its motor in the simulator, and while a thing is held, that with which it was grasped.",
            "Opening and force of the fingers during each pick",
            partial(draw_grips, drawing),
        )


def _find_drives(record: RunRecord) -> Iterator[WorkFigure]:
    for robot, path in find_drives(record).items():
        yield WorkFigure(
            "drive",
            f"Path of {display_name(robot)}",
            "Where the base says it is.",
            "Path of the mobile base from above",
            partial(draw_drive, path, list_outlines(record.state)),
        )


def _describe(push: PushRecord) -> str:
    """Return which skill pressed, and on what: `PressButton on Button 1`."""
    on = " and ".join(map(display_name, push.on))
    return f"{push.within.skill} on {on}" if on else f"{push.within.skill} by {display_name(push.arm)}"


SWINGING = (
    " An overlay makes the tool faster and slower along the lanes all the time; the thick line is the speed without "
    "that, the mean over one period of the overlay."
)

FIGURES = (_find_wipings, _find_dirt, _find_pushes, _find_searches, _find_guidances, _find_handlings, _find_drives)
"""The figures of all kinds of work, in the order of the report."""
