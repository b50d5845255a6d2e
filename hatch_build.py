"""Makes what is in a wheel and not in the repository: the tables of the parser, and the page of the studio."""

from __future__ import annotations

import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

TABLES = "from skillc_dsl.parsing.tables import build_tables; build_tables()"


class BuildHook(BuildHookInterface):
    """Runs before a wheel is made of a checkout; without Node the wheel has no studio."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the tables, and build the page, which an editable installation takes from `make studio`."""
        subprocess.run([sys.executable, "-c", TABLES], cwd=Path(self.root) / "dsl", check=True)
        if version == "editable":
            return
        builder = runpy.run_path(str(Path(self.root) / "studio" / "build.py"))
        if problem := builder["build_studio"]():
            print(builder["WITHOUT"].format(why=problem), file=sys.stderr)
