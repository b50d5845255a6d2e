"""Run the plan of an operation that waits for approval."""

from __future__ import annotations

from skillc.cli.server_access import make_operation_command

command = make_operation_command(
    "Run the plan of OPERATION, which waits for approval. The events of `skillc logs` show it.",
    lambda operation: operation.approve(),
)
