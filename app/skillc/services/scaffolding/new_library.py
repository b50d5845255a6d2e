"""Creates a new project from a template in this package; the files are compiled before they are written."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from skillc.errors import RequestError, ServiceError
from skillc.services.library.files import find_library
from skillc.services.library.libraries import load_vocabulary
from skillc.services.project.manifest import NAME
from skillc.services.reporting.files import inspect_path
from skillc.services.scaffolding.project_templates import DEFAULT, TEMPLATES, Template, open_templates
from skillc_compiler import pipeline
from skillc_dsl.editions import NEWEST
from skillc_dsl.source import Source
from skillc_dsl.spelling import did_you_mean

FILES = (
    ("skillc.toml", "common/skillc.toml.j2"),
    ("{name}.skill", "{template}/library.skill.j2"),
    ("tasks.skill", "{template}/tasks.skill.j2"),
    ("tests.skill", "{template}/tests.skill.j2"),
    ("cell.ttl", "{template}/cell.ttl.j2"),
    ("tests/test_{name}.py", "common/test_library.py.j2"),
    (".github/workflows/check.yml", "common/check.yml.j2"),
    ("README.md", "common/README.md.j2"),
    (".gitignore", "common/gitignore.j2"),
)
SCENE_PREFIX = "lab"
"""The prefix of the individuals in the templates' scenes."""


def create_library(folder: Path, template: str = DEFAULT) -> tuple[Path, ...]:
    """Write a new project into a new folder, whose last part is the library's name, and return the files.

    RequestError if the folder exists, the name is invalid or there is no such template; ServiceError if the folder
    cannot be created. With an error nothing is written.
    """
    chosen = next((each for each in TEMPLATES if each.name == template), None)
    if chosen is None:
        known = did_you_mean(template, [each.name for each in TEMPLATES])
        raise RequestError(f"there is no template `{template}`; {known}")
    found = inspect_path(folder)
    if found.kind == "unusable":
        raise RequestError(f"{folder} {found.is_what}; choose another name")
    if found.kind != "missing":
        raise RequestError(f"{folder} already exists; choose another name or remove it")
    texts = _texts(folder.name, chosen)
    try:
        return write_folder(texts, folder)
    except OSError as error:
        raise ServiceError(f"cannot create {folder}: {error.strerror}; nothing was written") from error


def _texts(name: str, template: Template) -> dict[str, str]:
    """Return the texts of the project `name` by relative path; RequestError for an invalid name."""
    if not NAME.fullmatch(name):
        near = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_0123456789")
        hint = f"; try `{near}`" if NAME.fullmatch(near) else ""
        raise RequestError(f"`{name}` is not a valid library name: use a-z, 0-9 and `_`, starting with a letter{hint}")
    environment = open_templates()
    values = {"name": name, "edition": NEWEST, **_values(name, template)}
    files = (*FILES, *((each, f"{{template}}/{each}.j2") for each in template.own_files))
    texts = {
        path.format(name=name): environment.get_template(file.format(template=template.name)).render(values)
        for path, file in files
    }
    _try_out(name, texts)
    return texts


def _values(name: str, template: Template) -> dict[str, str | tuple[str, ...]]:
    """Return what the files of a template say about it."""
    skill = "".join(part.capitalize() for part in name.split("_"))
    texts = {key: getattr(template, key).format(skill=skill) for key in ("summary", "skills", "scene", "change")}
    steps = sorted(step.format(skill=skill) for step in template.steps)
    files = {"own_files": template.own_files, "extras": template.extras}
    return {"skill": skill, "steps": json.dumps(steps), **files, **texts}


def write_folder(texts: Mapping[str, str], folder: Path) -> tuple[Path, ...]:
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
    errors = [each for each in outcome.diagnostics if each.severity == "error"]
    if errors:
        raise RequestError(f"the library cannot be called `{name}`: {errors[0].message}")
