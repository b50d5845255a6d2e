"""A search for a path that takes long ends with what is in the way: the watchdog knows that the run goes on."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest

from collision.around import aside, pillar, posture, world
from ends import slow_search
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.scene.saving import save_scene
from skillc_runtime.world.state.world_state import WorldState

SCENE = "iiwa_table"
TASK = """use rparts, skiros
import "motion.skill"
prefix lab: <http://example.org/lab#>

task aside {
    scene "cell.ttl"
    do    TakePosture(arm: lab:Iiwa-1, posture: "aside")
}
"""


@pytest.mark.slow
def test_a_search_that_takes_longer_than_a_tick_may_fails_and_says_what_is_in_the_way(tmp_path: Path) -> None:
    state = world(SCENE, [*pillar(SCENE), *posture(SCENE, "aside", aside(SCENE).tolist())])
    save_scene(state, tmp_path / "cell.ttl", WorldState.empty(state.vocabulary))
    (tmp_path / "reach.skill").write_text(TASK, encoding="utf-8")
    (tmp_path / "skillc.toml").write_text('name = "reach"\n', encoding="utf-8")
    command = (
        sys.executable,
        str(slow_search.__file__),
        "4",
        "run",
        f"{tmp_path}:aside",
        "--tick-timeout",
        "1",
        "--json",
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)
    result = msgspec.json.decode(done.stdout, type=TaskResult)
    assert (done.returncode, result.status) == (3, "failed"), done.stderr
    assert result.failure is not None and "lab:Pillar; no way around was found" in result.failure
