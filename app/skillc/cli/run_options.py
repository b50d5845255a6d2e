"""The options of commands that run something in simulation: the fields of a specification, which they get whole."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import click

from skillc.cli.completions import complete_scene, complete_task
from skillc.cli.options import BACKEND, SHARE, Function
from skillc.cli.struct_options import struct_options
from skillc_runtime.recording.run_spec import ATTENDED_ELSEWHERE, RunSpec


class PaceType(click.ParamType[str]):
    """How fast time passes: `fast`, `real`, or a factor."""

    name = "pace"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the text, which is a pace."""
        from skillc_runtime.execution.pace import parse_pace

        try:
            parse_pace(value)
        except ValueError as error:
            self.fail(str(error), param, ctx)
        return str(value)


def run_options(only: Collection[str] | None = None) -> Callable[[Function], Function]:
    """Return what adds the options of a run, `only` those if it is given, and gives the function a `RunSpec` first."""
    return struct_options(
        RunSpec,
        only,
        without=ATTENDED_ELSEWHERE,
        types={"pace": PaceType(), "backend": BACKEND, "speed": SHARE},
        complete={"scene": complete_scene, "beside": complete_task},
    )
