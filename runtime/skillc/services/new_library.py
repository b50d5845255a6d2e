"""Creates a new library from the templates in this package; the files are compiled before they are written."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from skillc.services.errors import RequestError, ServiceError
from skillc.services.files import inspect_path
from skillc.services.libraries import load_vocabulary
from skillc.services.library_files import find_library
from skillc_compiler import pipeline
from skillc_dsl.source import Source

TEMPLATES = Path(__file__).parent / "templates"
FILES = (
    ("{name}.skill", "library.skill.j2"),
    ("tasks.skill", "tasks.skill.j2"),
    ("cell.ttl", "cell.ttl.j2"),
    ("tests/test_{name}.py", "test_library.py.j2"),
    (".github/workflows/check.yml", "check.yml.j2"),
    ("README.md", "README.md.j2"),
    (".gitignore", "gitignore.j2"),
)
SCENE_PREFIX = "lab"
"""The prefix of the individuals in the template's scene."""
NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")


def create_library(folder: Path) -> tuple[Path, ...]:
    """Write a new library into a new folder, whose last part is the library's name, and return the files.

    RequestError if the folder exists or the name is invalid; ServiceError if the folder cannot be created. With an
    error nothing is written.
    """
    found = inspect_path(folder)
    if found.kind == "unusable":
        raise RequestError(f"{folder} {found.is_what}; choose another name")
    if found.kind != "missing":
        raise RequestError(f"{folder} already exists; choose another name or remove it")
    texts = _texts(folder.name)
    try:
        return _write(texts, folder)
    except OSError as error:
        raise ServiceError(f"cannot create {folder}: {error.strerror}; nothing was written") from error


def _texts(name: str) -> dict[str, str]:
    """Return the texts of the library `name` by relative path; RequestError for an invalid name."""
    if not NAME.fullmatch(name):
        near = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_0123456789")
        hint = f"; try `{near}`" if NAME.fullmatch(near) else ""
        raise RequestError(f"`{name}` is not a valid library name: use a-z, 0-9 and `_`, starting with a letter{hint}")
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        undefined=StrictUndefined,
        variable_start_string="<<",
        variable_end_string=">>",
        keep_trailing_newline=True,
        autoescape=False,
    )
    values = {"name": name, "skill": "".join(part.capitalize() for part in name.split("_"))}
    texts = {path.format(name=name): environment.get_template(file).render(values) for path, file in FILES}
    _try_out(name, texts)
    return texts


def _write(texts: Mapping[str, str], folder: Path) -> tuple[Path, ...]:
    """Write the files into a new folder and return their paths; with an OSError nothing remains.

    They are written into a temporary folder beside it, which is renamed.
    """
    above = [each for each in (folder.parent, *folder.parent.parents) if not each.exists()]
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=".skillc-", dir=folder.parent) as beside:
            made = Path(beside, folder.name)
            for path, text in texts.items():
                (made / path).parent.mkdir(parents=True, exist_ok=True)
                (made / path).write_text(text, encoding="utf-8")
            made.rename(folder)
    except OSError:
        for each in above:
            with suppress(OSError):
                each.rmdir()
        raise
    return tuple(folder / path for path in texts)


def _try_out(name: str, texts: Mapping[str, str]) -> None:
    """Compile the files; RequestError if the name conflicts with another."""
    if name in {*load_vocabulary().prefixes, SCENE_PREFIX}:
        raise RequestError(f"the library cannot be called `{name}`: it is the prefix of a vocabulary")
    sources = [Source(path, text) for path, text in texts.items() if path.endswith(".skill")]
    outcome = pipeline.compile(sources, load_vocabulary(), find_library(Path("std")).importable, name)
    if outcome.diagnostics:
        raise RequestError(f"the library cannot be called `{name}`: {outcome.diagnostics[0].message}")
