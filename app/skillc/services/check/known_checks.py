"""Checks a library with all that is known from earlier checks, and stores what it finds for later ones."""

from __future__ import annotations

from skillc.services.check.edit_checks import check_edits, recall_vocabulary
from skillc.services.check.snapshots import SNAPSHOT, Snapshot, take_snapshot
from skillc.services.library.answer_store import AnswerStore
from skillc.services.library.check_inputs import CHECK, CheckInputs
from skillc.services.tasks.value_checks import files_with_texts
from skillc_compiler.program.slices import outlines_of
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo


def check_with(memo: Memo, store: AnswerStore | None, inputs: CheckInputs) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a library, and store them unless an input changes meanwhile."""
    memo.store, memo.around = store, inputs.around
    before = store.load(SNAPSHOT, (inputs.around,)) if store else None
    now = check_edits(inputs.library, before, memo) if isinstance(before, Snapshot) else None
    if now is not None:
        found, complete = now.found, True
    else:
        found, now, complete = _check_whole(inputs, memo)
    if store and complete and inputs.are_current():
        store.save(CHECK, (inputs.digest,), found)
        if now is not None:
            store.save(SNAPSHOT, (inputs.around,), now)
        store.flush()
    return found


def _check_whole(inputs: CheckInputs, memo: Memo) -> tuple[tuple[Diagnostic, ...], Snapshot | None, bool]:
    """Check everything; the result has a snapshot if the library compiles, and whether there was time for all."""
    # After an edit of skills, this is mostly not imported.
    from skillc.services.check.library_checks import check_whole
    from skillc.services.space.verdicts import TaskLooks

    look = TaskLooks(memo.store)
    checked = check_whole(inputs.library, inputs.scene, memo, look.judge)
    if checked.program is None or memo.store is None:
        return checked.diagnostics, None, look.in_time
    recall_vocabulary(memo, inputs.library.vocabularies)  # from now on it is there for checks of edits
    now = take_snapshot(checked, outlines_of(checked.program, memo), files_with_texts(checked.program), look.looked)
    return checked.diagnostics, now, look.in_time
