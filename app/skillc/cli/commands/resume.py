"""Continue an operation that is paused."""

from __future__ import annotations

from skillc.cli.server_access import make_operation_command

command = make_operation_command("Continue OPERATION after a pause.", lambda operation: operation.resume())
