"""What a stranger does with the wheel: a project, changed, run, renamed, embedded, shown in a notebook, with an arm."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import venv
from pathlib import Path

import pytest

from distribution.test_wheel import ROOT, uv

pytestmark = pytest.mark.wheel

PART_C = """
lab:Part-C a sorting:WorkPart ; rdfs:label "green plate" ;
    skiros:SizeX 0.06 ; skiros:SizeY 0.03 ; skiros:SizeZ 0.02 ; skiros:Weight 0.1 ;
    skillc:on lab:Table ; skillc:atX 0.12 ; skillc:atY -0.3 .
"""
BOX = "skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;"
BOXES = (BOX.replace("0.16", "0.22").replace("0.06", "0.08"), BOX.replace("0.16", "0.13").replace("0.06", "0.05"))
EMBEDDED = """
import skillc

plan = skillc.plan("moved:sorting")
print([step.skill for step in plan.steps])
with skillc.start("moved:sorting") as operation:
    for event in operation.events():
        pass
run = operation.wait()
print(run.status, len(run.to_frame()) > 100)
"""
CELLS = ("import skillc; skillc.open_scene('moved/cell.ttl')", "skillc.run('moved:sorting')")
NOTEBOOK = f"""
import nbclient, nbformat

notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(each) for each in {CELLS!r}])
nbclient.NotebookClient(notebook, timeout=300, startup_timeout=300).execute()
print([sorted(output.data) for cell in notebook.cells for output in cell.outputs if "data" in output])
"""
LIFTER = (
    *("lab:Arm-1 a sorting:Lifter", "not lab:Arm-1 a skillc:Panda", "lab:Arm-1 skillc:hasSheet sorting:lifter-sheet"),
    *('lab:Arm-1 skiros:CompliantController "forward_dynamics"', "lab:Arm-1 skillc:hasSensor lab:Sensor-1"),
    "lab:Sensor-1 a skillc:ForceTorqueSensor",
)


class Stranger:
    """Someone with a clean environment, in an empty folder."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.bin = folder / "work", folder / "env/bin"
        self.folder.mkdir()
        self.env = {**os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}", "XDG_CACHE_HOME": str(folder / "cache")}
        self.env.pop("PYTHONPATH", None)

    def call(self, *command: str | Path, at: str = ".") -> str:
        words = [str(self.bin / command[0]), *map(str, command[1:])]
        done = subprocess.run(
            words, cwd=self.folder / at, env=self.env, capture_output=True, text=True, check=False, timeout=600
        )
        assert done.returncode == 0, f"{words}\n{done.stdout}{done.stderr}"
        return done.stdout


@pytest.fixture(scope="module")
def stranger(tmp_path_factory: pytest.TempPathFactory) -> Stranger:
    folder = tmp_path_factory.mktemp("walk")
    build = [sys.executable, "-m", "build", "--wheel", "--installer", "uv", "--outdir", str(folder), str(ROOT)]
    subprocess.run(build, check=True, capture_output=True)
    venv.create(folder / "env", with_pip=False)
    wheel = f"{next(folder.glob('skillc-*.whl'))}[run,planner,robots,data]"
    install = [uv(), "pip", "install", "-q", "--python", folder / "env/bin/python"]
    more = ["--constraint", ROOT / "constraints.txt", wheel, "nbclient", "ipykernel"]
    subprocess.run([*install, *more], check=True, capture_output=True)
    return Stranger(folder)


def test_a_project_is_changed_run_renamed_embedded_and_shown(stranger: Stranger) -> None:
    stranger.call("skillc", "new", "sorting", "--template", "pick-place")
    sorting = stranger.folder / "sorting"
    cell = (sorting / "cell.ttl").read_text("utf-8")
    assert cell.count(BOX) == 2 and cell.count("lab:Part-A, lab:Part-B") == 1
    for box in BOXES:
        cell = cell.replace(BOX, box, 1)
    cell = cell.replace("lab:Part-A, lab:Part-B", "lab:Part-A, lab:Part-B, lab:Part-C")
    (sorting / "cell.ttl").write_text(cell + PART_C, "utf-8")
    tasks = (sorting / "tasks.skill").read_text("utf-8")
    goal = "lab:Box-B contain lab:Part-B"
    (sorting / "tasks.skill").write_text(tasks.replace(goal, f"{goal} and lab:Box-A contain lab:Part-C"), "utf-8")
    assert json.loads(stranger.call("skillc", "check", "--json", at="sorting")) == []
    stranger.call("skillc", "run", "--out", "first", at="sorting")
    assert (sorting / "first/report.html").is_file() and (sorting / "first/film.mp4").stat().st_size > 10_000
    sorting.rename(stranger.folder / "moved")
    assert len(json.loads(stranger.call("skillc", "plan", "--json", at="moved/tests"))["plan"]) == 6
    steps, ended = stranger.call("python", "-c", EMBEDDED).splitlines()
    assert steps.count("Pick") == 3 and ended == "succeeded True"
    shown = stranger.call("python", "-c", NOTEBOOK)
    assert "image/svg+xml" in shown and shown.count("text/html") >= 1


def test_a_fourth_arm_from_its_urdf_does_the_same(stranger: Stranger) -> None:
    moved = "moved"
    assert (stranger.folder / moved).is_dir()
    lifter = ROOT / "tests/robot_import/lifter.urdf"
    stranger.call("skillc", "add", "robot", lifter, "--tip", "tool0", "--like", "ur5e", at=moved)
    stranger.call("skillc", "scene", "edit", "cell.ttl", *LIFTER, at=moved)
    assert json.loads(stranger.call("skillc", "check", "--json", at=moved)) == []
    run = json.loads(stranger.call("skillc", "run", "--json", at=moved))
    assert run["status"] == "succeeded" and len(run["plan"]) == 6
