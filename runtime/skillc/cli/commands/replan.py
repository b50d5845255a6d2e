"""Plan an operation again."""

from __future__ import annotations

from skillc.cli.server_access import make_operation_command

command = make_operation_command(
    "Halt what runs in OPERATION, which is paused or planned, and plan again.", lambda operation: operation.replan()
)
