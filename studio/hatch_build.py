"""Builds the page of the studio before a wheel is made of a checkout; without Node the wheel has no studio."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class StudioBuildHook(BuildHookInterface):
    """Runs `build.py`; an editable installation takes what `make studio` has built."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page; say why not if that is not possible."""
        if version == "editable":
            return
        builder = runpy.run_path(str(Path(self.root) / "studio" / "build.py"))
        if problem := builder["build_studio"]():
            print(builder["WITHOUT"].format(why=problem), file=sys.stderr)
