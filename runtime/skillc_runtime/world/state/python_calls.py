"""Python that vocabularies name by "module:name": what it raises fails the condition that asked, not the run."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from importlib import import_module
from typing import Any, TypeVar

from skillc_rdf.vocabulary.types import local_name

T = TypeVar("T")


class EvaluationError(ValueError):
    """A condition or expression that has no value; the message names what is missing and where."""


class InsufficientFacts(ValueError):
    """Too little is known to work something out; the message says what is missing."""


@lru_cache(maxsize=1024)
def load_python(target: str) -> Any:
    """Import "module:attribute"; EvaluationError when there is no such thing."""
    module, _, attribute = target.partition(":")
    try:
        return getattr(import_module(module), attribute)
    except Exception as error:  # foreign code: whatever it raises, it cannot be used
        expected = isinstance(error, ImportError | AttributeError | ValueError)
        reason = error if expected else f"{type(error).__name__}: {error}"
        raise EvaluationError(f"the Python function {target} cannot be loaded: {reason}") from error


def call_python(function: Callable[..., T], name: str, state: object, *arguments: object) -> T:
    """Call what is called `name` about a version of the world; whatever it raises becomes an EvaluationError."""
    try:
        return function(state, *arguments)
    except EvaluationError:
        raise
    except Exception as error:  # foreign code: whatever it raises fails the condition, not the run
        shown = ", ".join(local_name(str(argument)) for argument in arguments)
        raise EvaluationError(f"{name}({shown}) failed: {type(error).__name__}: {error}") from error
