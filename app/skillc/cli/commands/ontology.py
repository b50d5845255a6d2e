"""Show what an ontology holds, what of it is used, what has no effect and why, and how it maps onto the shipped ones.

With `--align`, propose which of its terms are below shipped ones, as an ontology in Turtle.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option


@click.command(cls=Command)
@click.argument("files", nargs=-1, required=True, type=PATH, metavar="FILE..")
@click.option("--library", type=PATH, help="The library whose use is shown; by default that of the project here.")
@click.option("--align", is_flag=True, help="Propose which terms are below shipped ones, with the ground of each.")
@json_option
def command(files: tuple[Path, ...], library: Path | None, align: bool, as_json: bool) -> None:
    """Show what the ontologies in FILE.. hold: terms, individuals, axioms by kind, imports, and what becomes of them.

    They are read beside the shipped ontologies, with what they import. Axioms that are ignored have no effect on skills
    and scenes; remarks say why.

    `--align` prints proposals as Turtle, each with its ground: a name or label that both terms have. Those that could
    be several terms, or would make something impossible, are comments. Nothing is changed: save what is right beside
    the skills.
    """
    from skillc.cli.console import print_json, print_result, print_text
    from skillc.cli.output.ontology import format_descriptions
    from skillc.services.library.files import find_library
    from skillc.services.library.ontologies import describe_ontologies, open_ontologies
    from skillc.services.project.loading import find_project

    own = find_library(library) if library else find_library(Path()) if find_project(Path()) else None
    opened = open_ontologies(files)
    described = describe_ontologies(opened, own)
    if align:
        from skillc.services.library.ontology_alignment import format_proposals, propose_alignment

        proposals = propose_alignment(opened, described)
        if as_json:
            print_json(proposals)
        else:
            print_result(format_proposals(proposals, opened.vocabulary.prefixes))
    elif as_json:
        print_json(described)
    else:
        print_text(format_descriptions(described))
