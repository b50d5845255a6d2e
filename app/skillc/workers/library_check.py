"""Checks a library for the cells of a server, which run exactly what was checked.

Cells and their Python code stand on what the server was started with: a library that names another Python module, reads
another folder or changes the vocabulary is checked, and refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import msgspec
from msgspec import structs

from skillc.cells.library import encode_library
from skillc.contract.library import (
    ImplementationDescription,
    LibraryDescription,
    ParameterDescription,
    SkillDescription,
    TaskDescription,
)
from skillc.errors import DiagnosticsError, ServiceError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import LibraryFiles, find_library
from skillc.services.library.modules import find_modules, module_of
from skillc.services.project.loading import find_project
from skillc_dsl.encoding import decode, read_file
from skillc_model import conditions
from skillc_model.format_type import format_type
from skillc_model.skills import Implementation, Parameter, Primitive, Requirement, Skill, SkillLibrary, Task
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.platforms.memory import limit_memory
from skillc_runtime.platforms.python_modules import SHIPPED


def describe_library(library: SkillLibrary) -> LibraryDescription:
    """Return the description of a library; skills and tasks are in the order of their names."""
    skills = tuple(_describe_skill(each, library) for _, each in sorted(library.skills.items()))
    tasks = tuple(_describe_task(each, library.vocabulary) for _, each in sorted(library.tasks.items()))
    return LibraryDescription(library.name, library.hash, skills, tasks)


def _describe_skill(skill: Skill, library: SkillLibrary) -> SkillDescription:
    return SkillDescription(
        skill.name,
        skill.doc,
        _describe_parameters(skill.parameters, library.vocabulary),
        _texts(skill.pre),
        tuple(each.text for each in skill.post),
        tuple(_describe_implementation(each, skill) for each in library.implementations_of(skill.name)),
        float(skill.duration.value) if isinstance(skill.duration, conditions.Literal) else None,
    )


def _describe_implementation(implementation: Implementation, skill: Skill) -> ImplementationDescription:
    own = tuple(each for each in _texts(implementation.pre) if each not in _texts(skill.pre))
    return ImplementationDescription(implementation.name, implementation.doc, own)


def _describe_task(task: Task, vocabulary: Vocabulary) -> TaskDescription:
    return TaskDescription(task.name, task.doc, _describe_parameters(task.parameters, vocabulary), task.goal_text)


def _describe_parameters(parameters: Iterable[Parameter], known: Vocabulary) -> tuple[ParameterDescription, ...]:
    return tuple(
        ParameterDescription(each.name, each.direction, format_type(each.type, known), each.doc) for each in parameters
    )


def _texts(requirements: Iterable[Requirement]) -> tuple[str, ...]:
    return tuple(each.text for each in requirements)


MEMORY_BYTES = 4 * 2**30
"""The largest address space of a process that checks."""
MAX_DIAGNOSTICS = 20
RESTART = "start the server again to use it"
_NAMED = re.compile(r"""["'>]([A-Za-z_][\w.]*):[A-Za-z_]\w*["'<]""")
"""A text "module:Class", which may name a control law."""


class LibraryBasis(msgspec.Struct, frozen=True):
    """What a server was started with: the folders of a library, the Python modules that it names, its vocabulary.

    Only the digest of the vocabulary is kept.
    """

    folders: tuple[str, ...]
    modules: tuple[str, ...]
    vocabulary: str


@dataclass(frozen=True, slots=True)
class CheckedLibrary:
    """A library without errors; `content` is what cells run, `description` what the API shows."""

    name: str
    hash: str
    content: bytes
    description: LibraryDescription
    basis: LibraryBasis


@dataclass(frozen=True, slots=True)
class LibraryRefused:
    """Why a library cannot be used."""

    why: str


def read_checked(path: Path, scenes: Iterable[Path] = ()) -> CheckedLibrary:
    """Read and check a library and note the modules that it, its ontologies and scenes name.

    RequestError if there is none, DiagnosticsError if it has errors.
    """
    files = find_library(path)
    library = compile_valid(files)
    texts = (*(each.text for each in files.vocabularies), *(_read_text(each) for each in scenes))
    named = {module for text in texts for module in _NAMED.findall(text)}
    modules = sorted({*named, *find_modules(library)})
    basis = LibraryBasis(find_folders(files), tuple(modules), digest_vocabulary(library.vocabulary))
    return CheckedLibrary(library.name, library.hash, encode_library(library), describe_library(library), basis)


def check_again(request: tuple[str, LibraryBasis]) -> CheckedLibrary | LibraryRefused:
    """Return a library as it is now, or why cells cannot run it that stand on `basis`."""
    limit_memory(MEMORY_BYTES)
    path, basis = request
    try:
        return _check(Path(path), basis)
    except DiagnosticsError as error:
        found = [str(each) for each in error.diagnostics if each.severity == "error"]
        more = [f"and {len(found) - MAX_DIAGNOSTICS} more"] if len(found) > MAX_DIAGNOSTICS else []
        return LibraryRefused("\n".join(found[:MAX_DIAGNOSTICS] + more))
    except (ServiceError, OSError) as error:
        return LibraryRefused(str(error))
    except MemoryError:
        return LibraryRefused("checking it needs too much memory")


def _check(path: Path, basis: LibraryBasis) -> CheckedLibrary | LibraryRefused:
    project = find_project(path if path.is_dir() else path.parent)
    roots = [each.root for each in (project, *project.others())] if project else []
    ontologies = [each for known in ((project, *project.others()) if project else ()) for each in known.ontologies]
    for folder in (*roots, *ontologies):
        if not any(folder.resolve().is_relative_to(each) for each in basis.folders):
            return LibraryRefused(f"it now reads {folder}, with which the server was not started; {RESTART}")
    library = compile_valid(find_library(path))
    for each in library.implementations.values():
        if isinstance(each.body, Primitive) and not _is_known(module := module_of(each.body.python), basis):
            why = f"`{each.name}` names the Python module {module}, with which the server was not started; {RESTART}"
            return LibraryRefused(f"{each.source}: {why}")
    if digest_vocabulary(library.vocabulary) != basis.vocabulary:
        return LibraryRefused(f"its vocabulary has changed, which the worlds of the cells are made of; {RESTART}")
    return CheckedLibrary(library.name, library.hash, encode_library(library), describe_library(library), basis)


def find_folders(files: LibraryFiles) -> tuple[str, ...]:
    """Return the folders from which a library is read, but for shipped ones."""
    projects = (files.project, *files.project.others()) if files.project else ()
    folders = [files.root, *(each.root for each in projects), *(o for each in projects for o in each.ontologies)]
    return tuple(dict.fromkeys(str(each.resolve()) for each in (*folders, *catalogue.user_folders())))


def digest_vocabulary(vocabulary: Vocabulary) -> str:
    """Return a digest of the meaning of all terms; places and comments are not part of it."""
    tables = (vocabulary.classes, vocabulary.relations, vocabulary.properties, vocabulary.functions)
    terms = [structs.replace(each, source=None, comment="") for table in tables for _, each in sorted(table.items())]
    return sha256(msgspec.json.encode(terms, order="deterministic")).hexdigest()


def _is_known(module: str, basis: LibraryBasis) -> bool:
    return module.startswith(SHIPPED) or module in basis.modules


def _read_text(file: Path) -> str:
    return decode(str(file), read_file(file)).text
