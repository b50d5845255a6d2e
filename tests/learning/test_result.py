"""Which candidate is proposed, whether fresh trials confirm it, and what is said of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from learning.runners import BASIS, aim
from skillc.cli.layout import TerminalPage
from skillc.cli.output.learning import format_learned
from skillc.errors import RequestError
from skillc.services.learning.evidence import write_evidence
from skillc.services.learning.figures import World
from skillc.services.learning.page import render_page
from skillc.services.learning.result import (
    Learned,
    Tried,
    choose,
    compare_fresh,
    describe_candidates,
    list_front,
)
from skillc.services.learning.study import Candidate

BOTH = aim("time, force_rmse", "coverage == 100 %")


def world(seed: int, time: float, rmse: float, coverage: float = 100.0) -> World:
    return World(seed=seed, figures={"simulated_time": time, "force_rmse": rmse, "coverage": coverage})


def make_candidates(objectives: Mapping[int, tuple[float, float]]) -> dict[int, Candidate]:
    """Return candidates with objectives, and others that break a constraint in between."""
    return {
        number: Candidate(
            number=number,
            values=(0.1 + number, 15.0),
            worlds={0: world(0, *objectives.get(number, (1, 1)), 100.0 if number in objectives else 90.0)},
            verdict="measured" if number in objectives else "infeasible",
        )
        for number in range(max((*objectives, 0)) + 1)
    }


@pytest.mark.parametrize(
    ("objectives", "front", "chosen"),
    [
        ({0: (50, 2)}, (0,), None),
        ({0: (50, 2), 1: (40, 1.5), 2: (30, 2.5)}, (2, 1), 1),  # 2 is worse in one objective
        ({0: (50, 2), 1: (60, 0.1), 2: (70, 2)}, (0, 1), 1),  # what is won is more than what is lost
        ({0: (50, 2), 1: (60, 1.9), 2: (70, 3)}, (0, 1), None),  # it is less
        ({0: (50, 2), 1: (10, 2.2), 2: (90, 9)}, (1, 0), 1),  # each one is worse in one objective
        ({1: (60, 3), 2: (40, 5), 3: (45, 3.5)}, (2, 3, 1), 3),  # the defaults break a constraint
        ({}, (), None),
    ],
)
def test_a_candidate_of_the_front_is_proposed(
    objectives: Mapping[int, tuple[float, float]], front: Sequence[int], chosen: int | None
) -> None:
    candidates = make_candidates(objectives)
    assert list_front(candidates, BOTH) == tuple(front)
    assert choose(candidates, BOTH) == chosen
    described = {each.number: each for each in describe_candidates(candidates, BASIS.learnable, BOTH)}
    assert described.keys() == candidates.keys()
    assert {number for number, each in described.items() if not each.violations} == objectives.keys()
    with pytest.raises(RequestError, match="--take 9: there is no such candidate"):
        choose(candidates, BOTH, 9)


def test_values_of_the_defaults_are_no_proposal() -> None:
    candidates = make_candidates({0: (50, 2), 1: (50, 2)})
    candidates[1].values = candidates[0].values
    assert choose(candidates, BOTH) is None


def make_result(learned_coverage: float) -> Learned:
    """Return a result whose candidate 1 is faster, with three fresh trials, in one of which it has this coverage."""
    before = {seed: world(seed, 50.0 + seed, 2.0) for seed in range(2, 5)}
    after = {
        seed: world(seed, 40.0 + 1.1 * seed, 2.0, learned_coverage if seed == 3 else 100.0) for seed in range(2, 5)
    }
    return Learned(
        task="wipe",
        scene="table.ttl with reality typical",
        minimise=("time", "force_rmse"),
        subject_to=("coverage == 100 %",),
        parameters=BASIS.learnable,
        seeds=(0, 1),
        wanted=3,
        candidates=(
            Tried(
                number=0,
                values=("0.1 m/s", "15 mm"),
                verdict="measured",
                trials=2,
                objectives=(50.0, 2.0),
                violations={},
            ),
            Tried(
                number=1,
                values=("0.2 m/s", "5 mm"),
                verdict="measured",
                trials=2,
                objectives=(40.0, 2.0),
                violations={},
            ),
            Tried(
                number=2,
                values=("0.3 m/s", "40 mm"),
                verdict="infeasible",
                trials=1,
                objectives=None,
                violations={"succeeds": 1.0},
                failures=("failed: <it slips>",),
            ),
        ),
        front=(1,),
        chosen=1,
        importances={"time": {"Wipe.wipe_lanes.speed": 0.9, "Wipe.wipe_lanes.radius": 0.1}, "force_rmse": {}},
        fresh=compare_fresh(BOTH, before, after),
        complete=True,
        diff="+    refine speed: Speed = 0.2 m/s\n",
        recordings={"defaults": "out/runs/defaults", "learned": "out/runs/candidate-1"},
    )


def test_fresh_trials_confirm_what_meets_the_constraints() -> None:
    good, bad = make_result(100.0), make_result(99.0)
    assert (good.is_confirmed, bad.is_confirmed) == (True, False)
    assert good.fresh is not None
    assert bad.fresh is not None
    assert (good.fresh.seeds, good.fresh.defaults_met, bad.fresh.learned_met) == ((2, 3, 4), 3, 2)
    time, rmse = good.fresh.objectives
    assert (time.defaults, time.learned) == pytest.approx((53.0, 43.3))
    assert time.interval is not None
    assert time.interval.low < -9.7 < time.interval.high < 0.0  # of the differences, which vary less than the times
    assert rmse.interval is not None
    assert rmse.interval.low == rmse.interval.high == 0.0


def test_the_evidence_says_how_it_was_found() -> None:
    text = " ".join(line.removeprefix("# ") for line in write_evidence(make_result(100.0), 1, "table.ttl"))
    assert text.startswith("Learned for wipe in table.ttl: least time, force_rmse, subject to coverage == 100 %,")
    assert (
        "candidate 1 of 3, tried with seeds 0 to 1. With seeds 2 to 4, which were not used to choose it, 3 of 3" in text
    )
    assert "time 53 -> 43.3 (" in text


def test_the_terminal_and_the_page_have_the_front_and_what_fresh_trials_say() -> None:
    learned = make_result(99.0)
    text = format_learned(learned, TerminalPage(120, False))
    assert "3 of 3 candidates tried in 5 trials" in text
    assert "1    40           2  0.2 m/s  5 mm    proposed" in text
    assert "time depends on: speed 90%, radius 10%" in text
    assert "with the fresh seeds 2 to 4, 2 of 3 trials met all constraints, with the defaults 3" in text
    page = render_page(learned, Path("out"))
    assert page.count("<circle") == 2
    assert 'href="runs/candidate-1"' in page
    assert "2 of 3 trials met all constraints, with the defaults 3" in page
    assert "candidate 1, measured: speed 0.2 m/s, radius 5 mm" in page
