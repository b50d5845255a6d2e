"""Calls Python functions that vocabularies name by "module:name"; an exception fails the condition, not the run."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from importlib import import_module
from typing import Any, TypeVar

from skillc_rdf.vocabulary.types import local_name

T = TypeVar("T")

FOREIGN_ERRORS = (Exception, SystemExit)
"""What code of users may raise without ending the program; Ctrl-C is not among them."""


class EvaluationError(ValueError):
    """A condition or expression that cannot be evaluated; the message names what is missing and where."""


class InsufficientFacts(ValueError):
    """Too little is known to compute something; the message names what is missing."""


@lru_cache(maxsize=1024)
def load_python(target: str) -> Any:
    """Import "module:attribute"; EvaluationError when it does not exist."""
    module, _, attribute = target.partition(":")
    try:
        return getattr(import_module(module), attribute)
    except FOREIGN_ERRORS as error:  # foreign code: it may raise anything
        expected = isinstance(error, ImportError | AttributeError | ValueError)
        reason = error if expected else f"{type(error).__name__}: {error}"
        raise EvaluationError(f"the Python function {target} cannot be loaded: {reason}") from error


def call_python(function: Callable[..., T], name: str, state: object, *arguments: object) -> T:
    """Call a Python function with a version of the world; exceptions become EvaluationErrors with its `name`."""
    try:
        return function(state, *arguments)
    except EvaluationError:
        raise
    except FOREIGN_ERRORS as error:  # foreign code: it may raise anything, which fails the condition and not the run
        shown = ", ".join(local_name(str(argument)) for argument in arguments)
        raise EvaluationError(f"{name}({shown}) failed: {type(error).__name__}: {error}") from error
