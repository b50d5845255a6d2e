"""Frames of trials and runs have numbers and texts; what was not measured is missing, and no zero."""

from __future__ import annotations

from math import isnan

from msgspec import structs

from skillc.values.flat_rows import make_flat_row
from skillc.values.trials import Trials
from skillc_runtime.evaluation.measures.work import PlacingWork, PressingWork, WipingWork
from skillc_runtime.evaluation.report.result import PlacementResult, PushResult
from skillc_runtime.evaluation.trials.judging import judge_series
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.world.state.labels.labelled import LabelledIri
from trials.runners import wiping

BUTTON, ARM = LabelledIri("http://lab#Button", "lab:Button"), LabelledIri("http://lab#Arm", "lab:Arm")
PRESSED = PressingWork(button=BUTTON, required_n=10.0, held_n=10.05, greatest_n=11.0, duration_share=None)
PLACED = PlacingWork(thing=ARM, error_m=0.01, turned_deg=2.0, missed_m=None)
TRIAL = Trial(seed=1, status="succeeded", assumed=("a", "b"), works=(PRESSED, PLACED), sim_time_s=5.0)


def test_trials_have_a_column_for_each_number_and_no_objects() -> None:
    crashed = Trial(seed=2, status="crashed")
    wiped = structs.replace(TRIAL, seed=3, works=(wiping(),), greatest_force_n=20.0)
    frame = Trials(judge_series("press", "none", 3, [TRIAL, crashed, wiped])).to_frame()
    assert all(value is None or isinstance(value, bool | int | float | str) for value in frame.to_numpy().ravel())
    assert frame["lab:Button.held_n"].dtype == float and frame["lab:Button.held_n"].count() == 1
    assert list(frame["assumed"]) == ["a; b", "", "a; b"]
    assert list(frame["greatest_force_n"].isna()) == [True, True, False]
    assert isinstance(wiping(), WipingWork) and any(name.endswith(".coverage") for name in frame.columns)


def test_a_position_has_a_column_for_each_axis_also_if_it_is_not_known() -> None:
    placed = PlacementResult(
        thing=ARM, holder=None, is_held=False, holder_known="", known="", believed_m=None, true_m=(0.1, 0.2, 0.3),
        error_m=None, turned_deg=None,
    )  # fmt: skip
    row = make_flat_row(placed)
    assert (row["thing"], row["holder"], row["true_x_m"], row["true_z_m"]) == ("lab:Arm", None, 0.1, 0.3)
    missing = [row[name] for name in ("believed_x_m", "believed_z_m", "error_m", "intended_y_m")]
    assert all(isinstance(each, float) and isnan(each) for each in missing)
    assert "intended_z_m" not in row


def test_several_names_are_one_text() -> None:
    push = PushResult(
        skill="Press", arm=ARM, on=(BUTTON, ARM), start_s=0.0, end_s=1.0, contact_s=None, force_command_n=4.0,
        force_mean_n=None, force_greatest_n=None, force_source="sensor", true_mean_n=None, true_greatest_n=None,
        travel_mm=None,
    )  # fmt: skip
    row = make_flat_row(push)
    assert (row["type"], row["on"]) == ("push", "lab:Button; lab:Arm")
