"""Adds files to a project: a skill, or a robot, gripper or tool as a copy of a shipped one."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

from skillc.errors import RequestError, ServiceError
from skillc.services.project.manifest import NAME
from skillc.services.project.project import MANIFEST, Project
from skillc.services.reporting.files import inspect_path, rewrite_file
from skillc.services.scaffolding.project_templates import open_templates
from skillc_dsl.spelling import did_you_mean
from skillc_ontology import catalogue

Kind = Literal["skill", "robot", "gripper", "tool"]
FOLDERS: Mapping[str, str] = {"robot": "robots", "gripper": "grippers", "tool": "tools"}
MODELS: Mapping[str, str] = {"robot": "iiwa14", "gripper": "wsg50", "tool": "eraser"}
"""The shipped devices that new ones are copies of, unless another is named."""
ONTOLOGY = "ontology"
_SUBJECT = re.compile(r"^(?P<prefix>\w+):(?P<local>[\w-]+) a (?P<cls>[\w:]+)", re.MULTILINE)
_SOURCE = re.compile(r'skillc:source "[^"]*"')
_MODEL = re.compile(r'skillc:model "(?P<path>[^"]*)"')


def add_files(project: Project, kind: Kind, name: str, like: str | None) -> tuple[Path, ...]:
    """Write the files of a new skill or device into a project and return those that were written or changed.

    `like` is the shipped device whose files are copied. RequestError if the name is invalid, a file exists, or there
    is no such device; ServiceError if a file cannot be written.
    """
    _check_name(name)
    if kind == "skill":
        if like is not None:
            raise RequestError("--like is for robots, grippers and tools")
        return _write({project.root / f"{name}.skill": _skill(name)})
    return add_device_files(project, kind, name, *_device(project, kind, name, like or MODELS[kind]))


def add_resized_tool(
    project: Project, name: str, like: str | None, size: Sequence[float]
) -> tuple[tuple[Path, ...], str]:
    """Write a tool as a copy of a shipped one with another size (3,) in m; return its files, and how a scene names it.

    RequestError as of `add_files`, and for a size that no tool in a hand has.
    """
    from skillc.services.scene.resized_tool import resize_tool

    _check_name(name)
    made = resize_tool(*_device(project, "tool", name, like or MODELS["tool"]), size, name)
    files = add_device_files(project, "tool", name, made.sheet, made.model)
    sizes = " ; ".join(f"skiros:Size{axis} {each:g}" for axis, each in zip("XYZ", made.size, strict=True))
    return files, f"skillc:hasSheet {project.name}:{name}-sheet ; {sizes} ; skiros:Weight {made.weight_kg:.3g}"


def _check_name(name: str) -> None:
    if not NAME.fullmatch(name):
        raise RequestError(f"`{name}` is not a valid name: use a-z, 0-9 and `_`, starting with a letter")


def add_device_files(project: Project, kind: Kind, name: str, sheet: str, model: str) -> tuple[Path, ...]:
    """Write a data sheet and a model into the ontology folder, and return the files that were written or changed.

    The manifest names the folder from then on. RequestError if a file exists; ServiceError if one cannot be written.
    """
    folder = (project.ontologies[0] if project.ontologies else project.root / ONTOLOGY) / FOLDERS[kind]
    written = _write({folder / f"{name}.ttl": sheet, folder / f"{name}.xml": model})
    return written if project.ontologies else (*written, _name_ontology(project))


def _skill(name: str) -> str:
    skill = _camel(name)
    return open_templates().get_template("add/skill.skill.j2").render(skill=skill, term=f"is{skill}Done")


def _device(project: Project, kind: str, name: str, like: str) -> tuple[str, str]:
    """Return the data sheet and the model of a device, as copies of a shipped one under names of the project."""
    shipped = catalogue.ROOT / FOLDERS[kind]
    known = {path.stem for path in shipped.glob("*.xml")}
    if like not in known:
        raise RequestError(f"there is no {kind} `{like}`; {did_you_mean(like, known)}")
    sheet = (shipped / f"{like}.ttl").read_text("utf-8")
    found = _MODEL.search(sheet)
    assert found is not None, "a shipped device has a model"
    model = f"{FOLDERS[kind]}/{name}.xml"
    text = _MODEL.sub(f'skillc:model "{model}"', _renamed(sheet, project.name, name))
    text = _SOURCE.sub(f'skillc:source "Copied from {like}: replace the numbers, and say where each is from."', text)
    prefix = f"@prefix {project.name}: <{project.namespace}> .\n"
    head, line, rest = text.partition("@prefix ")
    text = f"{_first_line(kind, like, head)}{prefix}{line}{rest}"
    return text, catalogue.model_path(found["path"]).read_text("utf-8")


def _first_line(kind: str, like: str, head: str) -> str:
    return f"# A {kind}, copied from {like}. {head.removeprefix('# ')}" if head.startswith("# ") else head


def _renamed(sheet: str, prefix: str, name: str) -> str:
    """Return a sheet whose individuals and classes have other names, with another prefix."""
    for found in list(_SUBJECT.finditer(sheet)):
        local = found["local"]
        new = _camel(name) if found["cls"] == "owl:Class" else f"{name}-{local.rpartition('-')[2]}"
        old = re.escape(f"{found['prefix']}:{local}")
        sheet = re.sub(rf"(?<![\w:-]){old}(?![\w-])", f"{prefix}:{new}", sheet)
    return sheet


def _name_ontology(project: Project) -> Path:
    """Name the ontology folder in the manifest, below the library's name."""
    path = project.root / MANIFEST
    text = project.source.text
    line = project.place_of("name").line
    lines = text.split("\n")
    rewrite_file(path, text, "\n".join((*lines[:line], f'ontology = ["{ONTOLOGY}"]', *lines[line:])))
    return path


def _write(texts: Mapping[Path, str]) -> tuple[Path, ...]:
    """Write new files, all or none of them."""
    for path in texts:
        found = inspect_path(path)
        if found.kind != "missing":
            raise RequestError(f"{path} {found.is_what} already; choose another name or remove it")
    done: list[Path] = []
    try:
        for path, text in texts.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            done.append(path)
            path.write_text(text, encoding="utf-8")
    except OSError as error:
        for path in done:
            path.unlink(missing_ok=True)
        raise ServiceError(f"cannot write {done[-1] if done else 'files'}: {error.strerror}") from error
    return tuple(done)


def _camel(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))
