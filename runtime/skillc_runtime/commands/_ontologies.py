"""Ontologies of the user's: the folders that `--ontology` and SKILLC_ONTOLOGY name. Nothing heavy is imported here."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

import click

from skillc_compiler.emit.headers import is_ours
from skillc_dsl.encoding import decode, read_file
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_runtime.commands._paths import look

COMMANDS = ("check", "compile", "doc", "graph", "plan", "run", "world")
"""The commands that read libraries or scenes, which all have the option."""
_VOCABULARY = re.compile(r"^[^#\n]*(?:owl:Ontology\b|owl#Ontology[>\"])", re.MULTILINE)


def with_option(command: click.Command) -> click.Command:
    """Add `--ontology` to a command, once."""
    if not any(parameter.name == "ontology" for parameter in command.params):
        command.params.append(
            click.Option(
                ["--ontology"],
                multiple=True,
                type=click.Path(path_type=Path, file_okay=False, exists=True),
                expose_value=False,
                callback=_enter,
                help=f"A folder of ontologies to use beside the shipped ones; so are those in {catalogue.VARIABLE}.",
            )
        )
    return command


def named() -> dict[str, Path]:
    """Return the files in the user's folders by the path that is shown; UsageError for a folder that there is not."""
    for folder in catalogue.folders():
        found = look(folder)
        if found.kind == "missing":
            raise click.UsageError(f"{catalogue.VARIABLE} names {folder}, and there is no such folder")
        if found.kind != "folder":
            raise click.UsageError(f"{catalogue.VARIABLE} names {folder}, which {found.is_what}")
    return dict(catalogue.own_files())


def is_vocabulary(path: Path) -> bool:
    """Whether a file beside skills is a vocabulary: it says that it is an owl:Ontology, which scenes do not.

    What skillc itself made of the library is none.
    """
    if path.suffix not in catalogue.ENDINGS:
        return False
    try:
        text = read_file(path).decode("utf-8", errors="replace")
    except OSError:
        return False
    return bool(_VOCABULARY.search(text)) and not is_ours(text)


def sources(files: Iterable[tuple[str, Path]]) -> tuple[Source, ...]:
    """Read files; UsageError for one that cannot be read."""
    found: list[Source] = []
    for shown, path in files:
        try:
            found.append(decode(shown, read_file(path)))
        except OSError as error:
            raise click.UsageError(f"{path} cannot be read: {error.strerror}") from error
    return tuple(found)


def _enter(context: click.Context, _option: click.Parameter, value: tuple[Path, ...]) -> tuple[Path, ...]:
    """Name the folders in the environment for as long as the command runs, before those named there."""
    before = os.environ.get(catalogue.VARIABLE)
    if value:
        os.environ[catalogue.VARIABLE] = os.pathsep.join([*map(str, value), *([before] if before else [])])
        context.call_on_close(lambda: _leave(before))
    return value


def _leave(before: str | None) -> None:
    if before is None:
        os.environ.pop(catalogue.VARIABLE, None)
    else:
        os.environ[catalogue.VARIABLE] = before
