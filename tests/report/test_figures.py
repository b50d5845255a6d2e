"""The figure of wiping: what it says, in which units, and that it is the same every time."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from skillc_runtime.evaluation.report.figure_files import render_figure
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing
from skillc_runtime.evaluation.report.wiping_figure import draw_figure

TIME = np.linspace(0.0, 10.0, 200)
WAY = np.column_stack([np.linspace(-150.0, 150.0, 200), np.zeros(200)])


def wiped(*, upright: bool = False) -> WipingDrawing:
    """Return one lane along the longer side of a surface."""
    dose = np.zeros((60, 80))
    dose[20:40, 5:75] = 0.5
    return WipingDrawing(
        surface="lab:Table-1",
        robot="lab:Iiwa-1",
        extent=np.array([300.0, 400.0] if upright else [400.0, 300.0]),
        covered=0.29,
        dose=dose.T if upright else dose,
        lanes=WAY[:, ::-1] if upright else WAY,
        tool=(WAY + 2.0)[:, ::-1] if upright else WAY + 2.0,
        time=TIME,
        lane_speed=np.full(200, 100.0),
        tool_speed=np.full(200, 90.0),
        overlaid=True,
        contact_time=TIME - 2.0,
        force=np.where(TIME > 1.0, 18.0, 0.0),
        force_n=18.0,
    )


def test_every_axis_has_a_unit_and_every_part_a_title_and_a_legend() -> None:
    parts = draw_figure([wiped(), wiped(upright=True)]).axes[:6]
    assert len(parts) == 6
    for axes in parts:
        assert axes.get_xlabel().endswith((", mm", ", s"))
        assert axes.get_ylabel().endswith((", mm", ", mm/s", ", N"))
        assert axes.get_title(loc="left")
        assert axes.get_legend() is not None


def test_a_surface_that_is_longer_along_y_is_drawn_lying_with_the_same_lines() -> None:
    lying, turned = (draw_figure([drawing]).axes[0] for drawing in (wiped(), wiped(upright=True)))
    assert (lying.get_xlabel()[0], turned.get_xlabel()[0]) == ("x", "y")
    for one, other in zip(lying.lines[:2], turned.lines[:2], strict=True):
        np.testing.assert_array_equal(one.get_xydata(), other.get_xydata())
    np.testing.assert_array_equal(lying.images[0].get_array(), turned.images[0].get_array())
    assert "29.0% wiped" in lying.get_title(loc="left")


def test_what_was_not_wiped_has_no_shade_and_columns_share_the_scale() -> None:
    short, long = wiped(), replace(wiped(), dose=4 * wiped().dose)
    shades = [axes.images[0] for axes in draw_figure([short, long]).axes if axes.images]
    assert [each.get_clim() for each in shades] == [(0.0, 2.0), (0.0, 2.0)]
    np.testing.assert_array_equal(np.ma.getmaskarray(shades[0].get_array()), short.dose == 0)


def test_the_same_drawing_gives_the_same_files() -> None:
    drawn = render_figure(lambda: draw_figure([wiped()]))
    assert drawn == render_figure(lambda: draw_figure([wiped()]))
    assert drawn.png.startswith(b"\x89PNG")
    assert ElementTree.fromstring(drawn.svg).tag.endswith("svg")


def test_there_is_no_figure_of_nothing() -> None:
    with pytest.raises(ValueError, match="no wiping"):
        draw_figure([])
