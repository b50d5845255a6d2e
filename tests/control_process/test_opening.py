"""What a cell of real arms needs is there when it opens: a tree that loads it in its ticks is silent for too long."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import astuple
from pathlib import Path

import pytest

from control_process.toy_link import _with_path
from simulation.cells import ARM, world
from skillc_runtime.backends.control_process.periods.facts import read_margins, read_patience
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import SKILLC

SCENE = "iiwa_table"

OPENED = """
import sys
from importlib import import_module
from pkgutil import iter_modules

from skillc_runtime.backends.control_process.opening import load_all

load_all()
before = set(sys.modules)
from skillc_runtime import primitives
for module in iter_modules(primitives.__path__, "skillc_runtime.primitives."):
    import_module(module.name)
from skillc_runtime.motion.numerics.compiled import COMPILES, list_imported
laws = list_imported()
assert laws or not COMPILES
print(sorted(set(sys.modules) - before), [each.__name__ for each in laws if each.code is None])
"""


@pytest.mark.early
@pytest.mark.slow
def test_what_skills_call_is_loaded_and_compiled() -> None:
    here = Path(__file__).parent
    ran = subprocess.run(
        [sys.executable, "-c", OPENED], stdout=subprocess.PIPE, text=True, check=True, cwd=here, env=_with_path()
    )
    assert ran.stdout == "[] []\n"


def arm(*stated: tuple[str, str, float]) -> ArmSpec:
    changes = [SetProperty(SKILLC + who if who else ARM[SCENE], SKILLC + what, number) for who, what, number in stated]
    return read_scene_spec(world(SCENE).with_changes(changes)).arms[0]


def test_how_long_it_waits_is_stated_by_the_arm_or_else_by_its_sheet() -> None:
    assert astuple(read_patience(arm())) == (0.25, 0.2, 0.1, 1.0, 1.0)
    assert astuple(read_margins(arm())) == (0.5, 0.05, 1.1)
    names = ("treeTimeout", "controlTimeout", "cycleTimeout", "settleTimeout", "brakeTimeout")
    on_sheet = [("iiwa14-sheet", name, 2.0 + number) for number, name in enumerate(names)]
    assert astuple(read_patience(arm(*on_sheet))) == (2.0, 3.0, 4.0, 5.0, 6.0)
    assert read_patience(arm(*on_sheet, ("", "treeTimeout", 1.0))).tree_s == 1.0
    margins = (("", "softStartTime", 2.0), ("iiwa14-sheet", "commandLead", 0.1), ("", "overspeed", 1.2))
    assert astuple(read_margins(arm(*margins))) == (2.0, 0.1, 1.2)
