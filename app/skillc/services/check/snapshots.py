"""Caches the last check of a library as outlines of its files, from which a check after an edit of skills can go on."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import msgspec

from skillc_compiler.program.outlines import FileOutline
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source
from skillc_model.planning_view import encode_view
from skillc_model.skills import SkillLibrary

if TYPE_CHECKING:
    from skillc.services.check.library_checks import Checked

SNAPSHOT = "snapshot"
"""The query whose answer is the last check of a library."""


class Snapshot(msgspec.Struct, frozen=True):
    """A library that compiled without errors: the digest and the outline of each file, and everything that was found.

    `views` are the digests of what the whole library reads of each skill. `texts` are the files with text values that
    may name something in a scene, `looked` the skills whose bodies were looked at in space; `found` is as
    `skillc check` writes it, and so is `of_scenes`, what of it compiling does not find. `individuals` are those of
    scenes by file, with their classes, and `scenes` the files of tasks.
    """

    digests: dict[str, str]
    outlines: dict[str, FileOutline]
    views: dict[str, str]
    texts: frozenset[str]
    looked: frozenset[str]
    found: tuple[Diagnostic, ...]
    of_scenes: tuple[Diagnostic, ...]
    individuals: dict[str, dict[str, list[str]]]
    scenes: dict[str, str]

    @property
    def individuals_by_task(self) -> dict[str, dict[str, list[str]]]:
        """The individuals in the scene of each task, with their classes."""
        return {task: self.individuals[file] for task, file in self.scenes.items()}

    def edited(self, sources: Iterable[Source]) -> dict[str, Source]:
        """Return those of the library's files that have another text now."""
        return {each.path: each for each in sources if self.digests.get(each.path) != digest_of(each)}


def take_snapshot(
    checked: Checked, outlines: Mapping[str, FileOutline], texts: Iterable[str], looked: Iterable[str]
) -> Snapshot:
    """Return the snapshot of a library that was checked and compiles, given the outlines of its files."""
    program, library, scenes = checked.program, checked.library, checked.scenes
    assert program is not None and library is not None, "the library compiles"
    files = {} if scenes is None else {task: str(scenes.files[task]) for task in scenes.individuals}
    return Snapshot(
        digests={unit.file.path: digest_of(Source(unit.file.path, unit.text)) for unit in program.files},
        outlines=dict(outlines),
        views=digest_views(library, library.skills),
        texts=frozenset(texts),
        looked=frozenset(looked),
        found=checked.diagnostics,
        of_scenes=checked.of_scenes,
        individuals={} if scenes is None else {files[task]: each for task, each in scenes.individuals.items()},
        scenes=files,
    )


def update_snapshot(
    before: Snapshot,
    edited: Mapping[str, Source],
    outlines: Mapping[str, FileOutline],
    found: Iterable[Diagnostic],
) -> Snapshot:
    """Return a snapshot with new outlines of edited files."""
    digests = {path: digest_of(source) for path, source in edited.items()}
    return msgspec.structs.replace(
        before,
        digests={**before.digests, **digests},
        outlines={**before.outlines, **outlines},
        found=tuple(found),
    )


def digest_views(library: SkillLibrary, skills: Iterable[str]) -> dict[str, str]:
    """Return the digests of what the whole library reads of skills."""
    views = {name: encode_view(library.skills[name], library.implementations_of(name)) for name in skills}
    return {name: hashlib.sha256(view).hexdigest() for name, view in views.items()}


def digest_of(source: Source) -> str:
    """Return the digest of a text."""
    read = f"{source.text}{source.unreadable or ''}"
    return hashlib.sha256(read.encode("utf-8", "surrogateescape")).hexdigest()
