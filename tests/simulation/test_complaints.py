"""What the physics complains of is told, and no file is left in the working folder."""

import os
import subprocess
import sys
from pathlib import Path

from waiting import LONG_S

PROGRAM = """
import mujoco, numpy
from skillc_runtime.backends.simulation.model.mujoco_warnings import log_warnings

log_warnings()
model = mujoco.MjModel.from_xml_string(
    "<mujoco><worldbody><body><freejoint/><geom size='0.1'/></body></worldbody></mujoco>"
)
data = mujoco.MjData(model)
data.qvel[:] = numpy.nan
mujoco.mj_step(model, data)
"""


def test_an_unstable_simulation_is_told_on_stderr(tmp_path: Path) -> None:
    paths = os.pathsep.join(str(Path(path).absolute()) for path in sys.path if path)
    told = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        timeout=LONG_S,
        check=True,
    )
    assert told.stderr.startswith("simulation: ") and "unstable" in told.stderr
    assert told.stdout == ""
    assert list(tmp_path.iterdir()) == []
