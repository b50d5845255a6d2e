"""A short series of kills; `make soak` runs a long one."""

from __future__ import annotations

from pathlib import Path

import pytest

from killed_servers.auditing import Faults
from killed_servers.series import KillSeries


@pytest.mark.early
@pytest.mark.sim
def test_what_is_killed_at_random_loses_nothing_and_repeats_nothing(tmp_path: Path) -> None:
    series = KillSeries(tmp_path, seed=1)
    try:
        found = list(series.kill(8))
    finally:
        series.end()
    assert found == [Faults()] * 8
    assert series.counts["killed: cell"] and series.counts["killed: server"] and series.counts["ended: interrupted"]
