"""How operations of a server are, in a few words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from skillc.contract.cell import CellStatus
    from skillc.contract.operation import OperationStatus


def remark_status(status: OperationStatus) -> None:
    """Print how an operation is to stderr."""
    from skillc.cli.console import print_remark

    print_remark(f"{status.id}: {describe_state(status)}")


def remark_waiting(cell: CellStatus) -> None:
    """Print to stderr that a cell which is off is waited for, and why it is off."""
    from skillc.cli.console import print_remark

    if cell.state == "off":
        print_remark(f"{cell.name} is off: {cell.reason}; waiting for it")


def remark_going_on(operation: str) -> None:
    """Print to stderr that an operation goes on without who watched it."""
    from skillc.cli.console import print_remark

    print_remark(f"{operation} goes on; `skillc attach` shows it, `skillc stop {operation}` stops it")


def describe_state(status: OperationStatus) -> str:
    """Return the state of an operation, why it is in it, and what becomes of a tool that pressed."""
    from skillc_runtime.planning.progress import describe_progress
    from skillc_runtime.recording.contact import SENTENCES
    from skillc_runtime.recording.known_facts import format_status

    words = format_status(status.state, status.verified, status.false_claims)
    planning = "" if status.planning is None else describe_progress(status.planning)
    asked = [f"asks: {each.text} ({' | '.join(each.choices)})" for each in status.prompts]
    contact = SENTENCES[status.contact]
    return ": ".join(filter(None, (words, status.reason, contact, planning, *asked, *status.false_claims)))
