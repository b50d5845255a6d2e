"""Libraries: loaded and checked, with their skills, tasks and pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from skillc.api.boundary import api_call
from skillc.api.picture import Picture
from skillc.errors import DiagnosticsError
from skillc.services.check.checking import CheckRequest, check_paths, check_sources
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library, find_scene
from skillc.services.tasks.listing import TaskEntry, default_library, list_tasks, tasks_of
from skillc.services.views.pictures import draw_declaration
from skillc.values.arguments import AnyPath, optional_path, require_path, require_text
from skillc.values.frames import make_table
from skillc_compiler.emit.picture import mermaid, svg
from skillc_dsl.diagnostics import Diagnostic
from skillc_model import codec
from skillc_model.skills import Skill, SkillLibrary


@dataclass(frozen=True, slots=True)
class Library:
    """A library without errors. `path` is its folder or file; `warnings` are what its check reports."""

    name: str
    path: Path
    warnings: tuple[Diagnostic, ...]
    tasks: Mapping[str, TaskEntry] = field(repr=False)
    _compiled: SkillLibrary = field(repr=False, compare=False)

    @property
    def skills(self) -> Mapping[str, Skill]:
        """Its skills by name, also those that it imports."""
        return self._compiled.skills

    @property
    def hash(self) -> str:
        """The hash of all that it consists of."""
        return self._compiled.hash

    def draw(self, name: str) -> Picture:
        """Return the picture of the behaviour trees of a skill or a task. RequestError if there is none."""
        with api_call():
            box = draw_declaration(self.path, require_text(name, "the name"))
        return Picture(name, svg.draw_document(box), mermaid.draw(box))

    def to_dict(self) -> dict[str, Any]:
        """Return the compiled library as plain data, as in `library.json`."""
        import json

        value: dict[str, Any] = json.loads(codec.dumps(self._compiled))
        return value

    def _repr_html_(self) -> str:
        rows = [(each.name, each.aim, each.scene) for each in self.tasks.values()]
        skills = ", ".join(sorted(self.skills))
        return (
            f"<p><b>{escape(self.name)}</b>: {escape(skills)}</p>"
            f"{make_table(('task', 'goal or calls', 'scene'), rows) if rows else ''}"
        )


def load_library(path: AnyPath | None = None) -> Library:
    """Load and check a library.

    `path` is its folder or its file, or the name of a shipped library or of a dependency of the project here; without
    it, it is the library of the project here, else the shipped wiping library. DiagnosticsError if it has errors,
    RequestError if there is none.
    """
    with api_call():
        wanted = optional_path(path, "the library")
        files = default_library() if wanted is None else find_library(wanted)
        checked = check_sources(CheckRequest(()), [files])
        if any(each.severity == "error" for each in checked.diagnostics):
            raise DiagnosticsError(checked.diagnostics, checked.texts)
        tasks = {each.name: each for each in tasks_of(files)}
        place = wanted if wanted is not None and wanted.suffix == ".skill" else files.root
        return Library(files.name, place.resolve(), checked.diagnostics, tasks, compile_valid(files))


def check(*paths: AnyPath, scene: AnyPath | None = None) -> tuple[Diagnostic, ...]:
    """Check libraries or files, without paths the project or folder here; return what is found, errors and warnings.

    `scene` is a scene that is checked too. RequestError for a path at which there is no library.
    """
    with api_call():
        wanted = tuple(require_path(each, "the path") for each in paths)
        where = optional_path(scene, "the scene")
        found = None if where is None else find_scene(where)
        return check_paths(CheckRequest(wanted or (Path(),), found)).diagnostics


def tasks() -> tuple[TaskEntry, ...]:
    """Return the tasks that can be named: of the project here, of its dependencies, and the shipped ones."""
    with api_call():
        return tuple(list_tasks())
