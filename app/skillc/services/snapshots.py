"""Caches the last check of a library as outlines of its files, from which a check after an edit of skills can go on."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from pathlib import Path

import msgspec

from skillc_compiler.program.outlines import FileOutline
from skillc_compiler.program.typed import Program
from skillc_dsl import cache
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.rendering import json
from skillc_dsl.source import Source
from skillc_model.planning_view import encode_view
from skillc_model.skills import SkillLibrary

_MOST = 500
"""The most entries in the cache; beyond it the older half is deleted."""


class Snapshot(msgspec.Struct, frozen=True):
    """A library that compiled without errors: the digest and the outline of each file, and everything that was found.

    `views` are the digests of what the whole library reads of each skill. `texts` are the files with text values that
    may name something in a scene, `looked` the skills whose bodies were looked at in space; `found` is as
    `skillc check` writes it.
    """

    digests: dict[str, str]
    outlines: dict[str, FileOutline]
    views: dict[str, str]
    texts: frozenset[str]
    looked: frozenset[str]
    found: str

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Everything that was found."""
        return json.read(self.found)

    def edited(self, sources: Iterable[Source]) -> dict[str, Source]:
        """Return those of the library's files that have another text now."""
        return {each.path: each for each in sources if self.digests.get(each.path) != digest_of(each)}


def take_snapshot(
    program: Program,
    library: SkillLibrary,
    outlines: Mapping[str, FileOutline],
    texts: Iterable[str],
    looked: Iterable[str],
    found: Iterable[Diagnostic],
) -> Snapshot:
    """Return the snapshot of a program without errors, given what it is compiled to and the outlines of its files."""
    digests = {unit.file.path: digest_of(Source(unit.file.path, unit.text)) for unit in program.files}
    views = digest_views(library, library.skills)
    return Snapshot(digests, dict(outlines), views, frozenset(texts), frozenset(looked), json.render(found, {}))


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
        found=json.render(found, {}),
    )


def digest_views(library: SkillLibrary, skills: Iterable[str]) -> dict[str, str]:
    """Return the digests of what the whole library reads of skills."""
    views = {name: encode_view(library.skills[name], library.implementations_of(name)) for name in skills}
    return {name: hashlib.sha256(view).hexdigest() for name, view in views.items()}


def digest_of(source: Source) -> str:
    """Return the digest of a text."""
    read = f"{source.text}{source.unreadable or ''}"
    return hashlib.sha256(read.encode("utf-8", "surrogateescape")).hexdigest()


def load_snapshot(around: str) -> Snapshot | None:
    """Return the snapshot of a library, None if there is none; `around` is the digest of all that it depends on."""
    path = _path(around)
    body = cache.load(path) if path else None
    try:
        return None if body is None else msgspec.msgpack.decode(body, type=Snapshot)
    except msgspec.MsgspecError:
        return None


def store_snapshot(around: str, snapshot: Snapshot) -> None:
    """Store the snapshot of a library in the place of the one before."""
    path = _path(around)
    if path is not None:
        cache.store(path, msgspec.msgpack.encode(snapshot))
        cache.delete_oldest(path.parent, _MOST, _MOST // 2)


def _path(around: str) -> Path | None:
    folder = cache.cache_folder()
    return folder / "snapshots" / around if folder else None
