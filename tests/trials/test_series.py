"""What a series of trials comes to: targets, what is said of those that miss them, tables and pages."""

from __future__ import annotations

import re
from typing import get_args

import pytest
from msgspec.structs import replace

from skillc.cli.layout import TerminalPage
from skillc.cli.output.trials import format_series
from skillc_runtime.evaluation.trials import page
from skillc_runtime.evaluation.trials.judging import judge_series
from skillc_runtime.evaluation.trials.targets import METRICS, RUNNING
from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria
from trials.runners import GOOD, good, wiped, wiping

FAILURE = replace(good(1), status="failed", reason="nothing to push against", works=(), coverage=0.0)

WORSE = {
    "coverage": ({"coverage": 0.999}, "coverage 99.9 %, wanted at least 100 %"),
    "mean force error": ({"force_mean_n": 9.7}, "mean force error 3 %, wanted at most 2 %"),
    "force RMSE": ({"force_rmse_n": 1.2}, "force RMSE 12 % of F, wanted at most 10 % of F"),
    "contact lost": ({"contact_lost": 0.001}, "contact lost 0.1 %, wanted at most 0 %"),
    "first impact": ({"first_impact_n": 21.0}, "first impact 2.1 x F, wanted at most 2 x F"),
    "vibration": ({"vibration_mm_s": 1.5}, "vibration 1.5 mm/s, wanted at most 1 mm/s"),
    "tilt": ({"tilt_rms_deg": 0.6}, "tilt 0.6 deg rms, wanted at most 0.5 deg rms"),
    "lane-end dwell": ({"lane_dwell_s": 0.03}, "lane-end dwell 0.03 s, wanted at most 0.02 s"),
}

OTHERS: dict[str, list[tuple[dict[str, float], str]]] = {
    "polishing": [
        ({"polished_share": 0.98}, "polished area 98 %, wanted at least 99 %"),
        ({"overlay_amplitude_m": 0.007}, "overlay amplitude 70 %, wanted at least 90 %"),
    ],
    "pressing": [
        ({"held_n": 9.0}, "held force 90 % of F, wanted at least 95 % of F"),
        ({"greatest_n": 13.0}, "greatest force 130 % of F, wanted at most 120 % of F"),
        ({"duration_share": 1.1}, "time 110 % of the skill's, wanted at most 100 % of the skill's"),
    ],
    "inserting": [
        ({"depth_m": 0.027}, "depth 90 % of the hole, wanted at least 98 % of the hole"),
        ({"greatest_n": 45.0}, "greatest force 45 N, wanted at most 40 N"),
        ({"duration_share": 1.1}, "time 110 % of the skill's, wanted at most 100 % of the skill's"),
    ],
    "teaching": [
        ({"position_error_m": 0.006}, "position error 6 mm, wanted at most 5 mm"),
        ({"greatest_n": 30.0}, "greatest force of the person 30 N, wanted at most 25 N"),
        ({"mean_n": 11.0}, "mean force of the person 11 N, wanted at most 10 N"),
        ({"duration_share": 1.1}, "time 110 % of the skill's, wanted at most 100 % of the skill's"),
    ],
    "placing": [],
}


def targeted(kind: str) -> list[str]:
    return [metric.name for metric in METRICS[kind] if metric.target is not None]


def test_every_target_of_every_kind_is_missed_by_some_trial_here() -> None:
    assert targeted("wiping") == list(WORSE)
    assert OTHERS.keys() | {"wiping"} == METRICS.keys() == GOOD.keys()
    for kind, worse in OTHERS.items():
        own = [name for name in targeted(kind) if name not in WORSE]
        assert [any(said.startswith(name) for _, said in worse) for name in own] == [True] * len(own)
        assert len(worse) == len(own)


@pytest.mark.parametrize(("kind", "changed", "said"), [(k, *each) for k, worse in OTHERS.items() for each in worse])
def test_other_work_that_misses_a_target_is_told_so(kind: str, changed: dict[str, float], said: str) -> None:
    assert find_unmet_criteria(good(1, GOOD[kind]), "none") == ()
    assert find_unmet_criteria(good(1, replace(GOOD[kind], **changed)), "none") == (said,)


def test_what_polishes_must_wipe_as_well() -> None:
    rough = replace(GOOD["polishing"], wiping=wiped("lab:Sheet-1", tilt_rms_deg=0.6))
    assert find_unmet_criteria(good(1, rough), "none") == ("tilt 0.6 deg rms, wanted at most 0.5 deg rms",)


def test_a_fixture_that_is_blocked_is_not_said_to_be_done() -> None:
    (told,) = find_unmet_criteria(good(1, GOOD["inserting"]), "obstacle")
    assert told.startswith("succeeded, wanted a failure that says why: depth 100 % of the hole")
    assert find_unmet_criteria(good(1), "obstacle") == ()


@pytest.mark.parametrize("name", targeted("wiping"))
def test_a_trial_that_misses_a_target_is_told_so(name: str) -> None:
    changed, said = WORSE[name]
    assert find_unmet_criteria(good(1), "none") == ()
    assert find_unmet_criteria(good(1, wiping(**changed)), "none") == (said,)
    both = good(1, wiping("lab:A"), wiping("lab:B", **changed))
    assert find_unmet_criteria(both, "none") == (f"lab:B: {said}",)


@pytest.mark.parametrize(
    ("disturbance", "trial", "said"),
    [
        ("none", FAILURE, "failed: nothing to push against"),
        ("none", replace(good(1), at_rest=False), "something still moved or pushed in the end"),
        ("none", replace(good(1), greatest_force_n=51.0), "a tool felt 51.0 N, the limit is 50 N"),
        ("none", replace(good(1), greatest_force_n=51.0, force_limit_n=None), None),
        ("missing", FAILURE, None),
        ("missing", good(1), "succeeded, wanted a failure that says why"),
        ("missing", replace(FAILURE, reason=None), "failed, wanted a failure that says why"),
        ("missing", replace(FAILURE, status="crashed"), "crashed: nothing to push against"),
        ("push", replace(good(1), works=(wiping(coverage=0.9),)), None),
        ("push", replace(good(1), coverage=0.99), "coverage 99.0 %, wanted 100 % in the end"),
        ("push", replace(good(1), coverage=0.9998), "coverage 99.9 %, wanted 100 % in the end"),
        ("obstacle", replace(good(1), coverage=0.9998), "succeeded, wanted a failure that says why: coverage 99.9 %"),
        ("none", replace(good(1), works=(wiping(coverage=0.9999),)), "coverage 99.99 %, wanted at least 100 %"),
        ("push", replace(good(1), pushed=False), "there was no push: nothing is done along a path or in a search"),
        ("take", replace(FAILURE, taken=True, reason="lab:Hand-1 has lost lab:Part-A"), None),
        ("take", replace(good(1), taken=True), None),
        ("take", good(1), "nothing was taken: nothing is held for long enough"),
        ("take", replace(FAILURE, taken=True, reason=None), "failed, wanted a reason"),
        ("push", FAILURE, "failed: nothing to push against"),
        ("obstacle", FAILURE, None),
        ("obstacle", replace(FAILURE, greatest_force_n=60.0), "a tool felt 60.0 N, the limit is 50 N"),
    ],
)
def test_what_shall_become_of_a_trial_depends_on_what_happens(
    disturbance: TrialDisturbance, trial: Trial, said: str | None
) -> None:
    told = find_unmet_criteria(trial, disturbance)
    assert said in told if said else told == ()


def test_spreads_are_those_of_all_trials_whatever_their_order() -> None:
    trials = [good(seed, wiping(tilt_rms_deg=tilt)) for seed, tilt in ((3, 0.3), (1, 0.1), (2, 0.9))]
    found = judge_series("clean", "none", 4, trials)
    (tilt,) = [spread for spread in found.spreads if spread.metric == "tilt"]
    assert (tilt.least, tilt.median, tilt.greatest, tilt.met) == (0.1, 0.3, 0.9, 2)
    assert tilt.values == (0.1, 0.9, 0.3)
    assert [failed.seed for failed in found.failed] == [2]
    assert (found.wanted, found.done, found.passed, found.is_good) == (4, 3, 2, False)
    assert found == judge_series("clean", "none", 4, trials[::-1])


def test_a_series_is_good_when_all_trials_are_and_the_median_is_on_target() -> None:
    assert judge_series("clean", "none", 2, [good(1), good(2)]).is_good
    assert not judge_series("clean", "none", 3, [good(1), good(2)]).is_good
    rough = judge_series("clean", "none", 2, [good(seed, wiping(force_rmse_n=0.6)) for seed in (1, 2)])
    assert rough.passed == 2 and not rough.is_good
    (missed,) = [spread.median_missed for spread in rough.spreads if spread.median_missed]
    assert missed == "median 6 % of F, wanted at most 5"


def shown(disturbance: TrialDisturbance, *trials: Trial) -> str:
    return format_series(judge_series("clean", disturbance, len(trials), trials), TerminalPage(200), is_unicode=True)


def test_the_table_has_every_metric_and_every_failed_seed() -> None:
    text = shown("none", good(1), good(2, wiping(tilt_rms_deg=0.75, lane_dwell_s=0.01)))
    assert "1 of 2 trials passed" in text
    for metric in METRICS["wiping"]:
        wanted = "" if metric.target is None else f".*{metric.sense.replace('-', ' ')} {metric.target:g}  +\\d of \\d"
        assert re.search(rf"^{re.escape(f'{metric.name}, {metric.unit}')} {wanted}", text, re.MULTILINE)
    assert "seed 2: tilt 0.75 deg rms, wanted at most 0.5 deg rms\n  reality 2" in text
    assert "tilt" not in shown("missing", FAILURE)


def test_the_page_draws_every_value_and_escapes_what_it_says() -> None:
    odd = replace(FAILURE, seed=7, reason="<b>no</b>")
    text = page.render_page(judge_series("clean", "none", 3, [good(1), good(2), odd]))
    measured = [metric for metric in METRICS["wiping"] if metric.of(wiping().wiping) is not None]
    bound = [metric for metric in measured if metric.target is not None]
    assert text.count("<circle") == 2 * len(measured) + 3 * len(RUNNING)
    assert text.count('class="target"') == len(bound) < len(measured)
    assert "&lt;b&gt;no&lt;/b&gt;" in text and "<b>" not in text
    assert "2 of 3 trials passed" in text


@pytest.mark.parametrize("count", [1, 2, 50])
def test_plots_stay_inside_their_frame(count: int) -> None:
    trials = [good(seed, wiping(tilt_rms_deg=0.01 * seed)) for seed in range(count)]
    plots = [page.plot_spread(spread) for spread in judge_series("clean", "none", count, trials).spreads]
    dots = [dot for plot in plots for dot in plot.dots]
    assert len(dots) == count * len(plots) > 0
    assert all(0 <= dot.x <= page.WIDTH and 0 <= dot.y <= page.HEIGHT for dot in dots)
    lines = [x for plot in plots for _, x in plot.lines]
    assert len(lines) > len(plots)
    assert all(0 <= x <= page.WIDTH for x in lines)


@pytest.mark.parametrize("disturbance", get_args(TrialDisturbance))
def test_a_success_with_a_false_claim_fails_and_is_named(disturbance: TrialDisturbance) -> None:
    claim = "lab:Part-A is claimed in lab:Bin-1 but lies on the floor, 0.43 m away"
    trials = [replace(good(0), false_claims=(claim,)), good(1)]
    series = judge_series("sort", disturbance, 2, trials)
    assert series.false_successes == 1
    assert f"false success: {claim}" in series.failed[0].reasons
    for text in (format_series(series, TerminalPage(200), is_unicode=True), page.render_page(series)):
        assert "1 of 2 succeeded with a false claim" in text
        assert claim in text


def test_a_failure_with_a_false_claim_is_no_false_success() -> None:
    failed = replace(good(0), status="failed", reason="dropped", false_claims=("lab:Part-A is elsewhere",))
    series = judge_series("sort", "none", 1, [failed])
    assert series.false_successes == 0
    assert series.failed[0].reasons == ("failed: dropped",)
