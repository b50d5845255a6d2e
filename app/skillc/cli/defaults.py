"""The defaults of options that the project here sets in its `skillc.toml`, in `[tool.COMMAND]`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from skillc.errors import DiagnosticsError, ServiceError
from skillc.services.project.loading import find_project

WITH_DEFAULTS = ("run", "plan", "trials")
"""The commands that have a table of defaults."""


def read_defaults(command: str) -> dict[str, Any]:
    """Return the defaults of a command's options by parameter; exit with 1 if the manifest has errors.

    Plans are made for the back end of runs.
    """
    try:
        project = find_project(Path())
    except DiagnosticsError as error:
        from skillc.cli.console import Terminal

        Terminal().show(error.diagnostics, error.texts)
        sys.exit(error.exit_code)
    except ServiceError as error:
        raise click.UsageError(str(error)) from error
    if project is None:
        return {}
    import msgspec

    settings = msgspec.structs.asdict(getattr(project.manifest.tool, command))
    if command == "plan":
        settings["backend"] = project.manifest.tool.run.backend
    set_ones = {name: value for name, value in settings.items() if value is not None}
    return {name: str(project.root / value) if name == "out" else value for name, value in set_ones.items()}
