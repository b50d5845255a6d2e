"""What the physics complains of is told, and no file is left in the working folder."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from skillc_runtime.backends.simulation.mujoco_warnings import log_warnings

BALL = "<mujoco><worldbody><body><freejoint/><geom size='0.1'/></body></worldbody></mujoco>"


def test_an_unstable_simulation_is_told_on_stderr(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    log_warnings()
    model = mujoco.MjModel.from_xml_string(BALL)
    data = mujoco.MjData(model)
    data.qvel[:] = np.nan
    mujoco.mj_step(model, data)
    told = capfd.readouterr()
    assert "simulation: " in told.err and "unstable" in told.err
    assert told.out == ""
    assert list(tmp_path.iterdir()) == []
