"""Plan an operation again."""

from __future__ import annotations

from skillc.cli.server_access import make_decision_command

command = make_decision_command(
    "Halt what runs in OPERATION, which is paused or planned, and plan again. If OPERATION was interrupted, another "
    "one continues it with a new plan; its id is printed.",
    "replan",
    lambda operation: operation.replan(),
)
