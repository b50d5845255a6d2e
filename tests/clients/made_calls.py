"""Makes `skillc/client/calls.py`: a method for each endpoint of the contract of which clients do just the request."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterable, Iterator
from textwrap import indent
from types import NoneType, UnionType
from typing import Any, Literal, TypeAlias, Union, get_args, get_origin, get_type_hints

from msgspec import structs

from clients.formatting import CLIENT, format_module
from skillc.contract.api.endpoint import Empty, Endpoint
from skillc.contract.api.endpoints import ENDPOINTS

TABLE = "skillc.contract.api.endpoints"
FILE = CLIENT / "calls.py"
Owner: TypeAlias = Literal["Server", "Cell", "Operation"]
CLASSES: dict[Owner, str] = {
    "Server": '''class ServerCalls:
    """Requests about a server, and about what belongs to none of its cells."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
''',
    "Cell": '''class CellCalls:
    """Requests about a cell."""

    def __init__(self, connection: Connection, name: str) -> None:
        self._connection = connection
        self.name = name
''',
    "Operation": '''class OperationCalls:
    """Requests about an operation."""

    def __init__(self, connection: Connection, status: OperationStatus) -> None:
        self._connection = connection
        self.status = status

    @property
    def id(self) -> str:
        """Its id, which no other has."""
        return self.status.id
''',
}
OWN: dict[Owner, str] = {"Server": "", "Cell": "self.name", "Operation": "self.id"}
HEAD = '''"""What clients do by a single request; made from the endpoints by `python tests/accept.py`, not edited."""

from __future__ import annotations

from skillc.client.connection import Connection
from skillc.contract.operation import OperationStatus
'''


def make_calls() -> str:
    """Return the text of the module."""
    shown = [each for each in ENDPOINTS if each.call is not None]
    classes = [
        CLASSES[owner] + "".join(_method(each, owner) for each in shown if _owner(each) == owner) for owner in OWN
    ]
    imports = "".join(sorted({line for each in shown for line in _imports(each)}))
    return format_module(HEAD + imports + "\n\n" + "\n\n".join(classes), FILE)


def _owner(endpoint: Endpoint[Any]) -> Owner:
    """Return whose method makes a request: its path begins with what that is about."""
    match endpoint.path.split("/")[1:3]:
        case ["cells", "{cell}"]:
            return "Cell"
        case ["operations", "{operation}"]:
            return "Operation"
        case _:
            return "Server"


def _method(endpoint: Endpoint[Any], owner: Owner) -> str:
    parts = endpoint.path_parameters[owner != "Server" :]
    structures = {"query": endpoint.query, "body": endpoint.body}
    given = {name: kind for name, kind in structures.items() if kind not in (None, Empty)}
    fields = [(each, get_type_hints(kind)) for kind in given.values() for each in structs.fields(kind)]
    fields.sort(key=lambda each: not each[0].required)
    stated = [f"{each.name}: {_name(hints[each.name])}{_default(each)}" for each, hints in fields]
    parameters = ", ".join(("self", *(f"{each}: str" for each in parts), *stated))
    arguments = [endpoint.name.upper(), *filter(None, (OWN[owner],)), *parts]
    for name, kind in given.items():
        values = ", ".join(f"{each.name}={each.name}" for each in structs.fields(kind))
        arguments.append(f"{name}={kind.__name__}({values})")
    return f'''
    async def {endpoint.call or endpoint.name}({parameters}) -> {_name(endpoint.answer)}:
        """{_document(endpoint, given.values())}"""
        return await self._connection.call({", ".join(arguments)})
'''


def _default(parameter: structs.FieldInfo) -> str:
    return "" if parameter.required else f" = {parameter.default!r}"


def _document(endpoint: Endpoint[Any], structures: Iterable[type]) -> str:
    """Return what a request does, and what its parameters are."""
    parts = (f"{endpoint.summary}.", *(inspect.getdoc(each) or "" for each in structures))
    text = indent("\n\n".join(parts), " " * 8).strip()
    return f"{text}\n        " if "\n" in text else text


def _imports(endpoint: Endpoint[Any]) -> Iterator[str]:
    """Yield the import of each name that the method of an endpoint has."""
    yield f"from skillc.contract.api.endpoints import {endpoint.name.upper()}\n"
    for kind in (endpoint.query, endpoint.body, endpoint.answer):
        for each in _find_classes(kind):
            if each not in (Empty, NoneType) and each.__module__ != "builtins":
                yield f"from {_find_module(each)} import {each.__name__}\n"


def _find_module(kind: type) -> str:
    """Return the module of the contract that has a class, also if it is one of the engine."""
    modules = (name for name in sorted(sys.modules) if name.startswith("skillc.contract.") and name != TABLE)
    found = (name for name in modules if getattr(sys.modules[name], kind.__name__, None) is kind)
    return kind.__module__ if kind.__module__.startswith("skillc.") else next(found)


def _find_classes(kind: Any) -> Iterator[type]:
    if isinstance(kind, type) and get_origin(kind) is None:
        yield kind
    for each in get_args(kind):
        yield from _find_classes(each)


def _name(kind: Any) -> str:
    """Return a type as it is written."""
    arguments = get_args(kind)
    if get_origin(kind) in (Union, UnionType):
        return " | ".join(map(_name, arguments))
    if get_origin(kind) is Literal:
        return f"Literal[{', '.join(map(repr, arguments))}]"
    if arguments:
        return f"{get_origin(kind).__name__}[{', '.join('...' if each is ... else _name(each) for each in arguments)}]"
    return "None" if kind is NoneType else str(kind.__name__)
