"""Skills that misbehave, each in its way, and one that does nothing for a minute."""

from __future__ import annotations

from pathlib import Path

REST = """
## Do nothing for a minute.
skill Rest {
    noplan
}
impl by_rest of Rest { do wait 60 s }
"""
SKILL = """
## Misbehave.
skill {name} {{
    noplan
}}
impl by_{name} of {name} {{ run python "bad:{name}" }}
"""
CODE = '''
import ctypes
import os
import time

import numpy as np

from skillc_runtime.primitives.primitive import Primitive, Status


class Late(Primitive):
    """Misbehaves after half a second, when whoever has submitted it knows."""

    def start(self):
        self.due = self.cell.now + 0.5

    def tick(self):
        if self.cell.now < self.due:
            return Status.RUNNING
        self.misbehave()
        return Status.SUCCESS


class Blocks(Late):
    def misbehave(self):
        time.sleep(1e6)


class Exits(Late):
    def misbehave(self):
        os._exit(7)


class Crashes(Late):
    def misbehave(self):
        ctypes.string_at(0)


class Devours(Late):
    def misbehave(self):
        self.eaten = [np.empty(2**30, np.uint8) for _ in range(10_000)]
'''
NAMES = ("Blocks", "Exits", "Crashes", "Devours")


def write_misbehaving(folder: Path) -> None:
    """Write the skills and their primitives into the folder of a library."""
    (folder / "bad.skill").write_text(REST + "".join(SKILL.format(name=each) for each in NAMES), encoding="utf-8")
    (folder / "bad.py").write_text(CODE, encoding="utf-8")
