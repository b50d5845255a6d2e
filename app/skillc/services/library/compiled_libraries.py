"""Compiles libraries without errors, each once for all that compiling reads."""

from __future__ import annotations

from skillc.errors import DiagnosticsError
from skillc.services.library.answer_store import AnswerStore
from skillc.services.library.check_inputs import digest_texts
from skillc.services.library.files import LibraryFiles, source_texts
from skillc_dsl.query import Memo
from skillc_model.skills import SkillLibrary


def compile_valid(files: LibraryFiles) -> SkillLibrary:
    """Return a library that has no errors, from the store if it is there; DiagnosticsError if it has errors."""
    digest, store = digest_texts(files), AnswerStore()
    library = Memo(store).recall("library", (digest,), lambda: _compile(files))
    if digest_texts(files) == digest:
        store.flush()
    return library


def _compile(files: LibraryFiles) -> SkillLibrary:
    # The compiler is slow to import.
    from skillc.services.library.bodiless import without_unasked
    from skillc.services.library.libraries import compile_library

    outcome = compile_library(files)
    if not outcome.ok:
        backends = (each.backend for each in outcome.value.tasks.values())
        asked = without_unasked(outcome.diagnostics, backends, files.is_symbolic)
        raise DiagnosticsError(asked, source_texts(files))
    return outcome.value
