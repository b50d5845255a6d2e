"""Finds tasks by their names, and lists them: those of the project here, of its dependencies, and the shipped ones."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Literal, assert_never

import msgspec

from skillc.errors import RequestError
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc.services.project.loading import find_project
from skillc_dsl.spelling import did_you_mean
from skillc_model.skills import SkillLibrary, Task

if TYPE_CHECKING:
    from skillc_dsl import syntax as s

DEFAULT_LIBRARY = "wiping"
"""The shipped library of tasks that are named without one, outside of projects."""


Origin = Literal["project", "dependency", "shipped"]


class TaskEntry(msgspec.Struct, frozen=True):
    """A task: what names it here (`name`), its library, what it does, and the scene that it is in as it is written.

    `origin` says whose library it is, `aim` is the text of its goal, or the calls of its body. `parameters` are as in
    its declaration, such as `tray: Carrier`.
    """

    name: str
    origin: Origin
    library: str
    aim: str
    scene: str
    doc: str
    file: str
    is_default: bool = False
    parameters: tuple[str, ...] = ()


def split_reference(reference: str) -> tuple[LibraryFiles, str]:
    """Split `LIBRARY:NAME` into the library and the name of a task.

    Without LIBRARY it is the library of the project here if that has such a task, else the shipped wiping library.
    """
    path, colon, name = reference.rpartition(":")
    if colon:
        return find_library(Path(path)), name
    shipped = SHIPPED / DEFAULT_LIBRARY
    if find_project(Path()) is None:
        return find_library(shipped), name
    here = find_library(Path())
    if name in task_names(here):
        return here, name
    others = find_library(shipped)
    return (others if name in task_names(others) else here), name


def choose_task(task: str | None) -> str | None:
    """Return the task that is named, or else the default one of the project here, if there is one."""
    if task is not None:
        return task
    project = find_project(Path())
    return project.manifest.task if project else None


def require_task(task: str | None) -> str:
    """Return the task that is named or the default one; RequestError if there is none."""
    chosen = choose_task(task)
    if chosen is None:
        raise RequestError('name a TASK, or set a default one with `task = "NAME"` in skillc.toml')
    return chosen


def default_library() -> LibraryFiles:
    """Return the library of the project here, or else the shipped wiping library."""
    return find_library(Path() if find_project(Path()) else SHIPPED / DEFAULT_LIBRARY)


def find_task(library: SkillLibrary, name: str) -> Task:
    """Return a task; RequestError suggests one that exists."""
    if name not in library.tasks:
        if name in library.skills:
            needed = ", ".join(f"{each.name}: .." for each in library.skills[name].parameters if each.direction == "in")
            raise RequestError(f"`{name}` is a skill, not a task: `--scene FILE --call '{name}({needed})'` runs it")
        elsewhere = [each.name for each in list_tasks() if each.name.endswith(f":{name}")]
        hint = f"did you mean `{elsewhere[0]}`?" if elsewhere else did_you_mean(name, library.tasks)
        more = f"{hint} " if hint else ""
        raise RequestError(f"there is no task `{name}` in {library.name}; {more}(`skillc tasks` lists all)")
    return library.tasks[name]


def task_names(files: LibraryFiles) -> frozenset[str]:
    """Return the names of the tasks of a library, also of those with errors."""
    named = files.project.manifest.tasks if files.project else ()
    return frozenset({*named, *(each.name.text for each in _declarations(files))})


def list_tasks() -> list[TaskEntry]:
    """Return the tasks of the project here, of the libraries that it depends on, and the shipped ones."""
    project = find_project(Path())
    found = list(_of_library(find_library(Path()), "project", "")) if project else []
    own = {each.name for each in found}
    for each in project.others() if project else ():
        found += _of_library(find_library(each.root), "dependency", f"{each.name}:")
    for folder in sorted(SHIPPED.iterdir()):
        if any(folder.glob("*.skill")):
            prefix = "" if folder.name == DEFAULT_LIBRARY else f"{folder.name}:"
            found += _of_library(find_library(folder), "shipped", prefix)
    return [each for each in found if each.origin == "project" or each.name not in own]


def tasks_of(files: LibraryFiles) -> tuple[TaskEntry, ...]:
    """Return the tasks of a library, named as in it."""
    return tuple(_of_library(files, "project" if files.project else "shipped", ""))


def _of_library(files: LibraryFiles, origin: Origin, prefix: str) -> Iterator[TaskEntry]:
    """Yield the tasks of a library; their names begin with `prefix`."""
    manifest = files.project.manifest if files.project else None
    default = manifest.task if manifest and not prefix else None
    scene = (manifest.scene if manifest else None) or ""
    for each in _declarations(files):
        yield TaskEntry(
            name=f"{prefix}{each.name.text}",
            origin=origin,
            library=files.name,
            aim=_one_line(each.goal_text) or _calls_of(each),
            scene=each.scene.value if each.scene else scene,
            doc=_one_line(each.doc),
            file=files.display_path(each.span.path),
            is_default=each.name.text == default,
            parameters=tuple(f"{parameter.name.text}: {_format_type(parameter.type)}" for parameter in each.parameters),
        )
    for name, goal in (manifest.tasks if manifest else {}).items():
        assert files.project is not None
        file = files.project.source.path
        aim = _one_line(goal.goal or goal.call or "")
        yield TaskEntry(f"{prefix}{name}", origin, files.name, aim, goal.scene or scene, "", file, name == default)


def _format_type(written: s.TypeName) -> str:
    """Return a type as it is written."""
    from skillc_dsl import syntax as s

    match written:
        case s.Name(text=text):
            return text
        case s.OfDimension(of=of, dimension=dimension):
            return f"{of.text} of {dimension.text}"
        case s.ListOf(element=element):
            return f"[{_format_type(element)}]"
        case _:
            assert_never(written)


def _declarations(files: LibraryFiles) -> Iterator[s.TaskDeclaration]:
    # The parser and its trees are slow to import, and a shipped task is found without them.
    from skillc_dsl import syntax as s
    from skillc_dsl.parsing.parser import parse

    for source in files.sources:
        declared = parse(source).value.declarations
        tasks = (each for each in declared if isinstance(each, s.TaskDeclaration))
        yield from (each for each in tasks if not isinstance(each, s.TestDeclaration))


def _calls_of(task: s.TaskDeclaration) -> str:
    """Return the skills that the body of a task calls, in order."""
    from skillc_compiler.program.written import calls_of

    calls = sorted(calls_of(task), key=lambda call: call.span)
    return ", ".join(dict.fromkeys(call.skill.text for call in calls))


def _one_line(text: str) -> str:
    return " ".join(text.split())
