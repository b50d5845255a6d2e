"""What figures and measures leave out of a run that was paused."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from report.test_figures import wiped as drawing
from simulation.test_metrics import lane, recording, wiped
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.measures.surfaces import measure_overlay_amplitudes
from skillc_runtime.evaluation.metrics.intervals import (
    exclude_pauses,
    exclude_standstill,
    subtract_intervals,
    total_s,
)
from skillc_runtime.evaluation.metrics.wiping import measure_wiping
from skillc_runtime.evaluation.report.contact_figures import draw_wipings
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.motion.time_scaling import RAMP_S
from skillc_runtime.recording.events import FORMAT, Paused, Resumed, TaskStarted
from skillc_runtime.recording.history.history_builder import HistoryBuilder

INTERVALS = st.lists(st.tuples(st.integers(0, 20), st.integers(0, 20)).filter(lambda each: each[0] < each[1]))


@given(INTERVALS, INTERVALS)
def test_what_is_left_is_in_an_interval_and_in_no_gap(
    intervals: list[tuple[int, int]], gaps: list[tuple[int, int]]
) -> None:
    left = subtract_intervals(intervals, gaps)

    def count(moment: float, among: list[tuple[float, float]]) -> int:
        return sum(start < moment < end for start, end in among)

    for moment in np.arange(0.5, 20.0):
        expected = 0 if count(moment, gaps) else count(moment, intervals)
        assert count(moment, list(left)) == expected


def test_the_ramps_around_a_pause_are_no_work_but_no_standstill_either() -> None:
    assert exclude_pauses([(0.0, 10.0)], [(2.0, 5.0)]) == ((0.0, 2.0), (5.0 + RAMP_S, 10.0))
    assert exclude_standstill([(0.0, 10.0)], [(2.0, 5.0)]) == ((0.0, 2.0 + RAMP_S), (5.0, 10.0))
    assert exclude_standstill([(0.0, 10.0)], [(2.0, 2.1)]) == ((0.0, 10.0),)
    assert total_s(exclude_pauses([(0.0, 10.0)], [(9.0, inf)])) == 9.0


def test_a_listener_notes_pauses_also_one_that_never_ends() -> None:
    heard = HistoryBuilder()
    start = TaskStarted(time=0.0, format=FORMAT, task="wipe")
    for event in (start, Paused(time=1.0), Resumed(time=2.5), Paused(time=4.0)):
        heard(event)
    assert heard.history.paused == ((1.0, 2.5), (4.0, inf))


def test_a_paused_wipe_has_the_figures_of_one_that_was_not() -> None:
    """A tool stops in the middle of a lane, is taken off, touches hard and goes on."""
    there = lane(0.0, 4000)
    stop, ramp = 2000, round(RAMP_S / 0.001)
    here = np.repeat(there[stop : stop + 1], 3000 + 2 * ramp, axis=0)
    force = np.full(len(there) + len(here), 10.0)
    force[stop + 1000 : stop + 2000], force[stop + 2500] = 0.0, 15.0
    force[stop + 3000 : stop + 3000 + ramp] = 11.0
    paused = recording(np.concatenate([there[:stop], here, there[stop:]]), force)
    whole = [(0.0, len(force) * 0.001)]
    metrics = measure_wiping(paused, whole, wiped(), [(2.0, 5.0)])
    assert (metrics.force_mean_n, metrics.force_rmse_n, metrics.contact_lost) == (10.0, 0.0, 0.0)
    assert metrics.first_impact_n == 15.0
    assert metrics.coverage == pytest.approx(0.05 / 0.30)
    assert metrics.duration_s == pytest.approx(len(force) * 0.001 - 3.0 - RAMP_S)
    spoilt = measure_wiping(paused, whole, wiped())
    assert spoilt.contact_lost > 0.1 and spoilt.force_rmse_n > 3.0


def test_the_amplitude_of_a_swing_is_that_of_its_longest_undisturbed_part() -> None:
    time = np.arange(0.0, 12.0, 0.001)
    swing = 0.015 * np.sin(2 * np.pi * 1.5 * time) * ((time < 2.0) | (time > 6.0))
    rows = recording(np.zeros((len(time), 2)), np.full(len(time), 10.0)).rows.copy()
    rows[:, 2] += 0.9 * swing
    rows[:, 12] += swing
    rows[:, 0] = time
    wiping = Wiping("s", "a", "t", 10.0, 0.0, ((0.0, 12.0),), ((2.0, 6.0),))
    assert wiping.longest_undisturbed == (6.0 + RAMP_S, 12.0)
    commanded, measured = measure_overlay_amplitudes(Recording(rows).between(*wiping.longest_undisturbed))
    assert commanded == pytest.approx(0.015, rel=0.06) and measured / commanded == pytest.approx(0.9)


def test_a_pause_is_marked_in_the_plots_over_time() -> None:
    without = draw_wipings([drawing()]).axes
    paused = draw_wipings([replace(drawing(), pauses=((2.0, 4.0), (6.0, 6.5)))]).axes
    for number in (1, 2):
        spans = [patch.get_extents().width for patch in paused[number].patches]
        assert len(spans) == len(without[number].patches) + 2
        assert "paused" in paused[number].get_legend_handles_labels()[1]
    assert len(paused[0].patches) == len(without[0].patches)
