"""Skills of robots: check libraries, plan, run and explain tasks. `docs/python.md` shows how, with examples.

The command line is `cli`, the language server `lsp`; `api` and `client` have what is exported here, `services` what
all share.
Names are imported when they are used, so that the command line starts quickly.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from skillc.api.event_stream import EventStream as EventStream
    from skillc.api.learning import Learned as Learned
    from skillc.api.learning import learn as learn
    from skillc.api.library import Library as Library
    from skillc.api.library import check as check
    from skillc.api.library import load_library as load_library
    from skillc.api.library import tasks as tasks
    from skillc.api.operation import Operation as Operation
    from skillc.api.picture import Figure as Figure
    from skillc.api.picture import Film as Film
    from skillc.api.picture import Picture as Picture
    from skillc.api.planning import Plan as Plan
    from skillc.api.planning import PlannedStep as PlannedStep
    from skillc.api.planning import PlanningError as PlanningError
    from skillc.api.planning import plan as plan
    from skillc.api.run import Run as Run
    from skillc.api.run import open_run as open_run
    from skillc.api.running import run as run
    from skillc.api.running import start as start
    from skillc.api.scene import Answer as Answer
    from skillc.api.scene import Scene as Scene
    from skillc.api.scene import open_scene as open_scene
    from skillc.api.table import QueryResult as QueryResult
    from skillc.api.trials import trials as trials
    from skillc.client.async_cell import AsyncCell as AsyncCell
    from skillc.client.async_operation import AsyncOperation as AsyncOperation
    from skillc.client.async_server import AsyncServer as AsyncServer
    from skillc.client.cell import ServerCell as ServerCell
    from skillc.client.connecting import connect as connect
    from skillc.client.connecting import connect_async as connect_async
    from skillc.client.errors import RefusedError as RefusedError
    from skillc.client.errors import UnavailableError as UnavailableError
    from skillc.client.operation import ServerOperation as ServerOperation
    from skillc.client.server import Server as Server
    from skillc.errors import DiagnosticsError as DiagnosticsError
    from skillc.errors import RequestError as RequestError
    from skillc.errors import SkillcError as SkillcError
    from skillc.values.trials import Trials as Trials
    from skillc_dsl.diagnostics import Diagnostic as Diagnostic

_MODULES = {
    "Answer": "skillc.api.scene",
    "AsyncCell": "skillc.client.async_cell",
    "AsyncOperation": "skillc.client.async_operation",
    "AsyncServer": "skillc.client.async_server",
    "Diagnostic": "skillc_dsl.diagnostics",
    "DiagnosticsError": "skillc.errors",
    "EventStream": "skillc.api.event_stream",
    "Figure": "skillc.api.picture",
    "Film": "skillc.api.picture",
    "Learned": "skillc.api.learning",
    "Library": "skillc.api.library",
    "Operation": "skillc.api.operation",
    "Picture": "skillc.api.picture",
    "Plan": "skillc.api.planning",
    "PlannedStep": "skillc.api.planning",
    "PlanningError": "skillc.api.planning",
    "RefusedError": "skillc.client.errors",
    "RequestError": "skillc.errors",
    "Run": "skillc.api.run",
    "Scene": "skillc.api.scene",
    "Server": "skillc.client.server",
    "ServerCell": "skillc.client.cell",
    "ServerOperation": "skillc.client.operation",
    "SkillcError": "skillc.errors",
    "QueryResult": "skillc.api.table",
    "Trials": "skillc.values.trials",
    "UnavailableError": "skillc.client.errors",
    "check": "skillc.api.library",
    "connect": "skillc.client.connecting",
    "connect_async": "skillc.client.connecting",
    "learn": "skillc.api.learning",
    "load_library": "skillc.api.library",
    "open_run": "skillc.api.run",
    "open_scene": "skillc.api.scene",
    "plan": "skillc.api.planning",
    "run": "skillc.api.running",
    "start": "skillc.api.running",
    "tasks": "skillc.api.library",
    "trials": "skillc.api.trials",
}
__all__ = sorted(_MODULES)


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module 'skillc' has no attribute {name!r}")
    from skillc.extras import naming_extras

    with naming_extras():
        value = getattr(import_module(_MODULES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_MODULES})
