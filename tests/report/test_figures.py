"""The figure of wiping: what it says, in which units, and that it is the same every time."""

from __future__ import annotations

from xml.etree import ElementTree

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from msgspec.structs import replace

from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.report.contact_figures import draw_wipings
from skillc_runtime.evaluation.report.figure import render_figure
from skillc_runtime.evaluation.report.plotting import STYLE
from skillc_runtime.evaluation.report.wiping import WipingDrawing, find_overlay_period

SVG = "{http://www.w3.org/2000/svg}"
TIME = np.linspace(0.0, 10.0, 200)
WAY = np.column_stack([np.linspace(-150.0, 150.0, 200), np.zeros(200)])


def wiped(*, upright: bool = False) -> WipingDrawing:
    """Return one lane along the longer side of a surface."""
    dose = np.zeros((60, 80))
    dose[20:40, 5:75] = 0.5
    return WipingDrawing(
        surface="Table 1",
        robot="Iiwa 1",
        extent=np.array([300.0, 400.0] if upright else [400.0, 300.0]),
        covered=0.29,
        dose=dose.T if upright else dose,
        lanes=WAY[:, ::-1] if upright else WAY,
        tool=(WAY + 2.0)[:, ::-1] if upright else WAY + 2.0,
        time=TIME,
        lane_speed=np.full(200, 100.0),
        tool_speed=np.full(200, 90.0),
        overlay_period_s=1.0,
        contact_time=TIME - 2.0,
        force=np.where(TIME > 1.0, 18.0, 0.0),
        force_n=18.0,
    )


def drawn(drawings: list[WipingDrawing]) -> Figure:
    """Return a figure as it is drawn for files."""
    with mpl.rc_context(STYLE):
        return draw_wipings(drawings)


def words(svg: bytes) -> list[str]:
    """Return the texts of an SVG, which are text."""
    return ["".join(each.itertext()).strip() for each in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def test_every_axis_has_a_unit_and_every_part_a_title() -> None:
    parts = drawn([wiped(), wiped(upright=True)]).axes[:8]
    maps = [each for each in parts if each.images]
    assert len(maps) == 2
    for axes in (each for each in parts if each.get_xlabel()):
        assert axes.get_xlabel().endswith((", mm", ", s"))
        assert axes.get_ylabel().endswith((", mm", ", mm/s", ", N"))
        assert axes.get_title(loc="left")


def test_x_of_each_surface_lies_across_to_scale_whatever_its_longer_side_is() -> None:
    lying, upright = (each for each in drawn([wiped(), wiped(upright=True)]).axes if each.images)
    for axes in (lying, upright):
        assert (axes.get_xlabel()[0], axes.get_ylabel()[0], axes.get_aspect()) == ("x", "y", 1.0)
    assert np.ptp(lying.get_xlim()) == np.ptp(upright.get_ylim())
    assert "29.0% wiped" in lying.get_title(loc="left")


@pytest.mark.slow
def test_not_wiped_is_in_the_legend_only_where_something_was_not() -> None:
    whole = replace(wiped(), dose=np.full((60, 80), 0.5))
    assert "not wiped" in words(render_figure(lambda: draw_wipings([wiped()])).svg)
    assert "not wiped" not in words(render_figure(lambda: draw_wipings([whole])).svg)


def test_what_was_not_to_be_wiped_does_not_count_as_not_wiped() -> None:
    spared = replace(wiped(), spared=wiped().dose == 0.0)
    named = words(render_figure(lambda: draw_wipings([spared])).svg)
    assert "not to be wiped" in named and "not wiped" not in named


def test_what_was_seen_dirty_in_the_end_and_what_had_been_clean_is_drawn() -> None:
    seen = wiped().dose == 0.0
    figure = drawn([replace(wiped(), seen_dirty=seen, covered=0.9, before=0.61)])
    (axes,) = (each for each in figure.axes if each.get_xlabel().startswith("x on the surface"))
    assert axes.get_title(loc="left").endswith("90.0% clean, 61.0% before")
    shown = np.ma.getmaskarray(axes.images[-1].get_array())
    np.testing.assert_array_equal(shown, ~seen)
    assert "seen dirty in the end" in {each.get_label() for each in axes.patches}


def test_the_shades_have_one_hue_get_darker_with_the_dose_and_share_their_scale() -> None:
    short, long = wiped(), replace(wiped(), dose=4 * wiped().dose)
    shades = [axes.images[-1] for axes in drawn([short, long]).axes if axes.images]
    assert [each.get_clim() for each in shades] == [(0.0, 2.0), (0.0, 2.0)]
    np.testing.assert_array_equal(np.ma.getmaskarray(shades[0].get_array()), short.dose == 0)
    red, green, blue, _ = shades[0].cmap(np.linspace(0.0, 1.0, 9)).T
    assert (blue > green).all() and (green > red).all(), "blue, not the yellow of a warning"
    assert (np.diff(0.2 * red + 0.7 * green + 0.1 * blue) < 0.0).all()


def test_the_band_of_the_force_fills_the_axis_and_what_is_beyond_it_is_told() -> None:
    force = np.where(TIME < 0.5, 0.0, 18.0 + np.sin(40.0 * TIME))
    force[150] = 31.0
    (axes,) = (
        each
        for each in drawn([replace(wiped(), contact_time=TIME - 1.0, force=force)]).axes
        if "N" in each.get_ylabel()
    )
    low, high = axes.get_ylim()
    assert low > 14.0 and high < 22.0
    assert {text.get_text() for text in axes.texts} == {"▲ up to 31.0", "▼ down to 0.0"}


def test_a_speed_with_an_overlay_is_drawn_without_it_too_and_says_so() -> None:
    time = np.linspace(0.0, 20.0, 2001)
    swinging = replace(
        wiped(), time=time, lane_speed=np.full(2001, 100.0), tool_speed=100.0 + 85.0 * np.sin(2 * np.pi * time),
        lanes=np.zeros((2001, 2)), tool=np.zeros((2001, 2)),
    )  # fmt: skip
    (axes,) = (each for each in drawn([swinging]).axes if "mm/s" in each.get_ylabel())
    assert "overlay of 1.00 s" in axes.get_title(loc="left")
    lines = {line.get_label(): np.asarray(line.get_ydata()) for line in axes.lines}
    mean = lines["mean over a period of the overlay: simulator truth"][100:-100]
    assert np.abs(mean - 100.0).max() < 2.0 < np.ptp(lines["tool with its overlay: simulator truth"])
    (plain,) = (each for each in drawn([replace(swinging, overlay_period_s=None)]).axes if "mm/s" in each.get_ylabel())
    assert "overlay" not in plain.get_title(loc="left")


def test_the_period_of_an_overlay_is_found_though_lanes_turn_and_it_does_not() -> None:
    time = np.arange(0.0, 31.0, 0.001)
    rows = np.zeros((len(time), 25))
    rows[:, 0], rows[:, 12] = time, 0.01 * np.sin(2 * np.pi * time)
    rows[:, 21] = np.where(time % 8.0 < 4.0, 0.1, -0.1)
    assert find_overlay_period(Recording(rows)) == pytest.approx(1.0, rel=0.01)
    assert find_overlay_period(Recording(rows[:10])) is None


def test_each_curve_says_where_it_comes_from() -> None:
    for axes in drawn([wiped()]).axes:
        for line in axes.lines:
            name = str(line.get_label())
            assert name.endswith((": simulator truth", ": commanded")) or name == "half the lane speed"


@pytest.mark.slow
def test_the_same_drawing_gives_the_same_files() -> None:
    drawn = render_figure(lambda: draw_wipings([wiped()]))
    assert drawn == render_figure(lambda: draw_wipings([wiped()]))
    assert drawn.png.startswith(b"\x89PNG")
    assert ElementTree.fromstring(drawn.svg).tag.endswith("svg")


def test_there_is_no_figure_of_nothing() -> None:
    with pytest.raises(ValueError, match="no wiping"):
        draw_wipings([])
