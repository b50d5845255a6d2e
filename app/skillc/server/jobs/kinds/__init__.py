"""The kinds of jobs, each the `KIND` of a module here; their requests and results are in the contract."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from pkgutil import iter_modules

from skillc.server.jobs.kind import JobKind


def find_kinds() -> Mapping[type, JobKind]:
    """Return the kinds by the types of their requests."""
    found: list[JobKind] = [import_module(f"{__name__}.{each.name}").KIND for each in iter_modules(__path__)]
    return {each.request: each for each in found}
