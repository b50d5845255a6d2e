"""Make a project of what other planners read: a domain in PDDL, and a problem.

Exit code 1 if a file has errors; then nothing is written.
"""

# ruff: noqa: N999 (the module is called as the command)
from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command, Group
from skillc.cli.console import print_remark
from skillc.cli.options import PATH


@click.group(cls=Group, context_settings={"help_option_names": ["-h", "--help"]})
def command() -> None:
    """Make a project of files of other planners."""


@command.command(
    cls=Command,
    examples="""
    skillc import pddl domain.pddl problem.pddl
    skillc import pddl domain.pddl problem.pddl --out haulage
    """,
)
@click.argument("domain", type=PATH)
@click.argument("problem", type=PATH, required=False)
@click.option("--out", type=PATH, metavar="FOLDER", help="The new folder; by default one called as the domain.")
def pddl(domain: Path, problem: Path | None, out: Path | None) -> None:
    """Write a project for the planning domain in the file DOMAIN, with the PROBLEM as scene and task.

    Types become classes, predicates relations and properties, actions skills without implementation, and objects
    individuals of a scene; names are in the style of the language. What the language cannot say is a warning, and a
    comment where it stood.
    """
    from skillc.cli.console import Terminal
    from skillc.services.pddl_import.importing import import_pddl

    imported = import_pddl(domain, problem, out)
    for path in imported.files:
        click.echo(path)
    Terminal().show(imported.warnings, imported.texts)
    folder = imported.files[0].parent
    if problem is not None:
        for line in ("Next steps:", f"  cd {folder}", "  skillc check", "  skillc plan"):
            print_remark(line)
