"""Compiles libraries without errors, each once for all that compiling reads."""

from __future__ import annotations

from skillc.errors import DiagnosticsError
from skillc.services.library.answer_store import AnswerStore
from skillc.services.library.check_inputs import CheckInputs
from skillc.services.library.files import LibraryFiles, source_texts
from skillc_dsl.query import Memo
from skillc_model.skills import SkillLibrary


def compile_valid(files: LibraryFiles) -> SkillLibrary:
    """Return a library that has no errors, from the store if it is there; DiagnosticsError if it has errors."""
    inputs, store = CheckInputs.of(files, None), AnswerStore()
    library = Memo(store).recall("library", (inputs.digest,), lambda: _compile(files))
    if inputs.are_current():
        store.flush()
    return library


def _compile(files: LibraryFiles) -> SkillLibrary:
    # The compiler is slow to import.
    from skillc.services.library.libraries import compile_library

    outcome = compile_library(files)
    if not outcome.ok:
        raise DiagnosticsError(outcome.diagnostics, source_texts(files))
    return outcome.value
