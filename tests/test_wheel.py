"""The wheel, built and installed in a clean environment outside the checkout, checks, compiles and runs."""

from __future__ import annotations

import json
import subprocess
import sys
import venv
from pathlib import Path

import pytest

pytestmark = pytest.mark.wheel

ROOT = Path(__file__).parents[1]
LIBRARY = """
use rparts
import "motion.skill"
prefix lab: <http://example.org/lab#>

## Take the home posture.
skill GoHome {
    in arm: ArmDevice
    noplan
}

impl directly of GoHome {
    do TakePosture(arm)
}

task go_home {
    scene "iiwa_table.ttl"
    do    GoHome(arm: lab:Iiwa-1)
}
"""


def call(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run([str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_wheel_works_in_a_clean_environment(tmp_path: Path) -> None:
    call(
        sys.executable, "-m", "build", "--wheel", "--installer", "uv", "--outdir", tmp_path / "dist", ROOT, cwd=tmp_path
    )
    wheel = next((tmp_path / "dist").glob("skillc-*.whl"))
    venv.create(tmp_path / "env", with_pip=False)
    python, skillc = tmp_path / "env/bin/python", tmp_path / "env/bin/skillc"
    constraints = ROOT / "constraints.txt"
    call(uv(), "pip", "install", "-q", "--python", python, "--constraint", constraints, wheel, cwd=tmp_path)
    library = tmp_path / "mine"
    library.mkdir()
    (library / "home.skill").write_text(LIBRARY, encoding="utf-8")
    call(skillc, "check", library, cwd=tmp_path)
    assert "A class does not exist" in call(skillc, "explain", "unknown-class", cwd=tmp_path)
    call(skillc, "compile", library, "-o", tmp_path / "build", cwd=tmp_path)
    assert json.loads((tmp_path / "build/library.json").read_text(encoding="utf-8"))["name"] == "mine"
    result = json.loads(call(skillc, "run", "mine:go_home", "--json", cwd=tmp_path))
    assert result["status"] == "succeeded"
    assert result["sim_time_s"] > 0.1
    plan = json.loads(call(skillc, "plan", "clean_table", "--json", cwd=tmp_path))
    assert [step["skill"] for step in plan["plan"]] == ["Pick", "Wipe"]
    assert "A*" in plan["planner"]


def uv() -> str:
    """Return the uv that set this checkout up, or the one on the path."""
    local = ROOT / ".tools/bin/uv"
    return str(local) if local.is_file() else "uv"
