"""Projects of a test, written from texts, and the commands of users in them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from textwrap import dedent

from click.testing import CliRunner, Result

from skillc.cli.main import skillc


def write_project(folder: Path, files: Mapping[str, str]) -> Path:
    """Write the files of a project with the name of its folder."""
    folder.mkdir(exist_ok=True)
    manifest = f'name = "{folder.name}"\nversion = "0.1.0"\n'
    for name, text in {"skillc.toml": manifest, **files}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def invoke(*arguments: object) -> Result:
    """Return the result of a command; an exception in it is raised."""
    result = CliRunner().invoke(skillc, list(map(str, arguments)))
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def ask_why(recording: str, question: str) -> str:
    """Return the answer to a question about a value, without its first line, which repeats the question."""
    return dedent("\n".join(invoke("why", recording, question).stdout.splitlines()[1:])).strip()
