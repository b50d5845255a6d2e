"""How services fail: exceptions whose messages are for users, with the exit code that a command ends with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source


class ServiceError(Exception):
    """What was asked for cannot be done; the message says why."""

    exit_code = 1


class RequestError(ServiceError):
    """The request is wrong: it names something that does not exist, or options that do not go together."""

    exit_code = 2


class DiagnosticsError(ServiceError):
    """A library, a scene, a goal or a call has errors: `diagnostics`, and the texts that they point into by path."""

    def __init__(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        super().__init__(f"{len(diagnostics)} problems")
        self.diagnostics = diagnostics
        self.texts = texts


class OutputError(Exception):
    """The standard output accepts nothing more; `reason` is what the system says."""

    def __init__(self, reason: OSError) -> None:
        super().__init__(f"cannot write to the standard output: {reason.strerror or reason}")
        self.reason = reason
