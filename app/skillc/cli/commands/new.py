"""Create a new project from a template.

It contains a manifest, skills, a scene, a task, a test and a CI workflow, and can be checked, planned, run and tried at
once.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_template
from skillc.cli.console import page_of, print_lines, print_remark
from skillc.cli.layout import TableCell
from skillc.cli.options import PATH

EXAMPLES = """
skillc new press_button
skillc new sorting --template pick-place
skillc new --list
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("name", required=False, type=PATH)
@click.option(
    "--template",
    default="press",
    show_default=True,
    metavar="TEMPLATE",
    shell_complete=complete_template,
    help="What the project is about.",
)
@click.option("--list", "list_", is_flag=True, help="List the templates.")
def command(name: Path | None, template: str, list_: bool) -> None:
    """Create a project in the new folder NAME, with skills, a scene, a task, a test and a CI workflow.

    The last part of NAME, such as `press_button`, names the library and its task.
    """
    from skillc.services.scaffolding.new_library import create_library
    from skillc.services.scaffolding.project_templates import TEMPLATES

    if list_:
        print_lines(page_of(sys.stdout).columns([(TableCell(each.name, "strong"), each.summary) for each in TEMPLATES]))
        return
    if name is None:
        raise click.UsageError("name the folder of the new project; --list lists the templates")
    for path in create_library(name, template):
        click.echo(path)
    for line in ("", "Next steps:", f"  cd {name}", "  skillc check", "  skillc run"):
        print_remark(line)
