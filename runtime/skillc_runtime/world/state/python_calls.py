"""Calls Python functions that vocabularies name by "module:name"; an exception fails the condition, not the run."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from types import TracebackType
from typing import Any, TypeVar

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.platforms.python_modules import import_named

T = TypeVar("T")

FOREIGN_ERRORS = (Exception, SystemExit)
"""What code of users may raise without ending the program, inside of `foreign_code`; Ctrl-C is not among them."""


class ForeignError(Exception):
    """Code of users raised what is neither an Exception nor Ctrl-C: its cause, such as a panic of an extension."""


class _ForeignCode:
    def __enter__(self) -> None:
        pass

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is not None and not isinstance(error, (*FOREIGN_ERRORS, KeyboardInterrupt)):
            raise ForeignError(f"{type(error).__name__}: {error}") from error


foreign_code = _ForeignCode()
"""`with foreign_code: ..` calls code of users: whatever it raises, but Ctrl-C, is one of FOREIGN_ERRORS outside."""


class EvaluationError(ValueError):
    """A condition or expression that cannot be evaluated; the message names what is missing and where."""


class InsufficientFacts(ValueError):
    """Too little is known to compute something; the message names what is missing."""


@lru_cache(maxsize=1024)
def load_python(target: str) -> Any:
    """Import "module:attribute"; EvaluationError when it does not exist."""
    module, _, attribute = target.partition(":")
    try:
        with foreign_code:
            return getattr(import_named(module), attribute)
    except FOREIGN_ERRORS as error:  # foreign code: it may raise anything
        expected = isinstance(error, ImportError | AttributeError | ValueError | ForeignError)
        reason = error if expected else f"{type(error).__name__}: {error}"
        raise EvaluationError(f"the Python function {target} cannot be loaded: {reason}") from error


def call_python(function: Callable[..., T], name: str, state: object, *arguments: object) -> T:
    """Call a Python function with a version of the world; exceptions become EvaluationErrors with its `name`."""
    try:
        with foreign_code:
            return function(state, *arguments)
    except EvaluationError:
        raise
    except FOREIGN_ERRORS as error:  # foreign code: it may raise anything, which fails the condition and not the run
        shown = ", ".join(local_name(str(argument)) for argument in arguments)
        reason = error if isinstance(error, ForeignError) else f"{type(error).__name__}: {error}"
        raise EvaluationError(f"{name}({shown}) failed: {reason}") from error
