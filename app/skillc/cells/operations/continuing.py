"""Continues operations that were interrupted: what can be decided about one, and how another one continues it."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import structs

from skillc.cells.database import DatabaseError
from skillc.cells.journal.reading import JournalReader, RecordedOperation
from skillc.contract.operation import OperationRequest
from skillc.errors import RequestError
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.execution.continuation import Continuation, continue_run, find_decisions
from skillc_runtime.execution.remainder import BodyRemainder, PlanRemainder, read_remainder
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.states import Decision


def decisions_about(operation: str, reader: JournalReader) -> tuple[Decision, ...]:
    """Return how an interrupted operation can be continued; not at all if its events cannot be read."""
    try:
        return find_decisions(_read_remainder(operation, reader))
    except DatabaseError:
        return ()


def find_interrupted(request: OperationRequest, reader: JournalReader) -> RecordedOperation:
    """Return the operation that a request continues; RequestError if there is none, or it cannot be continued.

    DatabaseError if the journal cannot be read.
    """
    name = request.continues
    if request.task or request.goal or request.call or request.arguments:
        raise RequestError(f"what is to be done is that of {name}; leave out the task, the goal or the call")
    operation = reader.find(name)
    if operation is None:
        raise RequestError(f"there is no operation {name}")
    ended = operation.ended
    if ended is None or ended.state != "interrupted":
        state = ended.state if ended else "not ended"
        raise RequestError(f"{name} has {state}; only an operation that was interrupted can be continued")
    if ended.continued_by:
        raise RequestError(f"{name} was continued by {ended.continued_by}")
    if not ended.decisions:
        raise RequestError(f"{name} cannot be continued, or the cell was reset since; submit its task again")
    return operation


def take_over(request: OperationRequest, earlier: OperationRequest) -> OperationRequest:
    """Return a request that does what an earlier one does."""
    return structs.replace(
        request, task=earlier.task, goal=earlier.goal, call=earlier.call, arguments=earlier.arguments
    )


def prepare_continuation(
    request: OperationRequest, assignment: Assignment, reader: JournalReader, library: SkillLibrary
) -> Continuation:
    """Return how an assignment, that of an interrupted operation, is continued as the request says.

    RequestError if that is not possible. DatabaseError if the journal cannot be read.
    """
    name, decision = request.continues, request.decision
    operation = reader.find(name)
    assert operation is not None and operation.ended is not None, "it was interrupted"
    remainder = _read_remainder(name, reader)
    decisions = find_decisions(remainder)
    if decision not in decisions:
        possible = f"it allows {', '.join(decisions)}" if decisions else "submit its task again"
        raise RequestError(f"`{decision}` is not possible after {name}; {possible}")
    if decision != "replan" and operation.ended.library_hash != library.hash:
        raise RequestError(f"the library has changed since {name}, so that only its task can be done again")
    if decision == "skip" and not request.why:
        raise RequestError("say why the step counts as done (`why`)")
    try:
        return continue_run(assignment, remainder, decision, library)
    except PlanError as error:
        raise RequestError(f"`{decision}` is not possible after {name}: {error}") from error


def _read_remainder(operation: str, reader: JournalReader) -> PlanRemainder | BodyRemainder | None:
    return read_remainder(tuple(_read_events(operation, reader)))


def _read_events(operation: str, reader: JournalReader) -> Iterator[Event]:
    after = 0
    while envelopes := reader.envelopes(operation, after):
        yield from (each.event for each in envelopes)
        after = envelopes[-1].sequence
