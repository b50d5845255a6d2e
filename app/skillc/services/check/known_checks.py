"""Checks a library with all that is known from earlier checks, and stores what it finds for later ones."""

from __future__ import annotations

from pathlib import Path

from skillc.services.check.edit_checks import check_edits
from skillc.services.check.snapshots import Snapshot, load_snapshot, store_snapshot, take_snapshot
from skillc.services.library import parse_cache
from skillc.services.library.cache_entries import DiskStore
from skillc.services.library.check_cache import CheckCacheEntry
from skillc.services.library.files import LibraryFiles
from skillc.services.library.vocabulary_cache import load_vocabulary_once
from skillc.services.tasks.value_checks import files_with_texts
from skillc_compiler.program.slices import outlines_of
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo


def check_uncached(library: LibraryFiles, scene: Path | None, memo: Memo | None) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a library, without any cache on disk."""
    from skillc.services.check.library_checks import Known, check_library
    from skillc.services.space.verdicts import TaskLooks

    return check_library(library, scene, Known(memo=memo, look=TaskLooks(use_cache=False).judge))


def check_and_store(entry: CheckCacheEntry, memo: Memo | None) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a library without an entry in the cache, and store them unless an input changes."""
    library = entry.library
    before = load_snapshot(entry.around)
    now = check_edits(library, before, parse_cache.parse_cached) if before else None
    store, complete = DiskStore(), True
    memo = memo or Memo()
    memo.store, memo.around = store, entry.around
    if now is not None:
        found = now.diagnostics
    else:
        found, now, complete = _check_whole(entry, memo)
    if complete and entry.is_current():
        entry.store(found)
        store.flush()
        if now is not None:
            store_snapshot(entry.around, now)
    parse_cache.delete_oldest_entries()
    return found


def _check_whole(entry: CheckCacheEntry, memo: Memo) -> tuple[tuple[Diagnostic, ...], Snapshot | None, bool]:
    """Check everything; the result has a snapshot if the library compiles, and whether there was time for all."""
    # After an edit of skills, this is mostly not imported.
    from skillc.services.check.library_checks import Known, check_whole
    from skillc.services.space.verdicts import TaskLooks

    look = TaskLooks(use_cache=True)
    known = Known(parse_cache.parse_cached, memo, look.judge)
    checked = check_whole(entry.library, entry.scene, known)
    if checked.program is None:
        return checked.diagnostics, None, look.in_time
    load_vocabulary_once(entry.library.vocabularies)  # from now on it is there for checks of edits
    now = take_snapshot(checked, outlines_of(checked.program, memo), files_with_texts(checked.program), look.looked)
    return checked.diagnostics, now, look.in_time
