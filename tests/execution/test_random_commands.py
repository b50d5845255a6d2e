"""Random requests at random ticks through random tasks, on a kinematic cell with its real primitives.

SKILLC_RUNS sets how many tasks the simulations draw.
"""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, Phase, given, settings

from execution import random_runs
from execution.random_runs import DRAWN, Drawn

RUNS = int(os.environ.get("SKILLC_RUNS", "75"))
PHASES = (Phase.explicit, Phase.reuse, Phase.generate)
QUIET = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much)


@settings(max_examples=15, deadline=None, derandomize=True, phases=PHASES, suppress_health_check=QUIET)
@given(DRAWN)
def test_whatever_is_requested_a_run_ends_in_order(drawn: Drawn) -> None:
    random_runs.check(random_runs.run(drawn))


@pytest.mark.sim
@settings(max_examples=RUNS, deadline=None, derandomize=True, suppress_health_check=QUIET)
@given(DRAWN)
def test_whatever_is_requested_many_runs_end_in_order(drawn: Drawn) -> None:
    random_runs.check(random_runs.run(drawn))
