"""Run the step of an operation again that failed or was interrupted."""

from __future__ import annotations

from skillc.cli.server_access import make_decision_command

command = make_decision_command(
    "Run the failed step of OPERATION again, which waits for a decision. If OPERATION was interrupted, another one "
    "continues it with the step that was running; its id is printed.",
    "retry",
    lambda operation: operation.retry(),
)
