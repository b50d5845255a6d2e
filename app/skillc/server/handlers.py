"""What handles each endpoint: the function in `routes` that has its name; the modules there are found by themselves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import Any

from skillc.contract.api.endpoint import Endpoint
from skillc.server import routes
from skillc.server.http.api_call import Handler


def find_handlers(endpoints: Iterable[Endpoint[Any]]) -> Mapping[str, Handler]:
    """Return the handlers of endpoints by name; KeyError if one has none."""
    known = {name: each for module in list_modules() for name, each in vars(module).items()}
    return {each.name: known[each.name] for each in endpoints}


def list_modules() -> list[ModuleType]:
    """Return the modules with handlers."""
    return [import_module(f"{routes.__name__}.{each.name}") for each in iter_modules(routes.__path__)]
