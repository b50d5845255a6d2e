"""The exceptions of skillc: messages for users, with the exit code of a command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source


class SkillcError(Exception):
    """The base of all errors that skillc reports; the message is a sentence that says what to do."""

    exit_code = 1


class ServiceError(SkillcError):
    """A request cannot be fulfilled; the message says why.

    Some say it with `diagnostics`, which point into `texts`, by path.
    """

    diagnostics: Sequence[Diagnostic] = ()
    texts: Mapping[str, Source] = MappingProxyType({})


class RequestError(ServiceError):
    """The request is wrong: it names something that does not exist, or combines options that conflict."""

    exit_code = 2


class DiagnosticsError(ServiceError):
    """A library, scene, goal or call has errors: `diagnostics`, and the texts that they point into, by path."""

    def __init__(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        super().__init__("\n".join(map(str, diagnostics)))
        self.diagnostics = diagnostics
        self.texts = texts


class OutputError(Exception):
    """The standard output cannot be written to; `reason` is the system's error."""

    def __init__(self, reason: OSError) -> None:
        super().__init__(f"cannot write to the standard output: {reason.strerror or reason}")
        self.reason = reason
