"""Run the step of an operation again that failed."""

from __future__ import annotations

from skillc.cli.server_access import make_operation_command

command = make_operation_command(
    "Run the failed step of OPERATION again, which waits for a decision.", lambda operation: operation.retry()
)
