"""Makes `studio/src/api/requests.ts`: what the page can ask the server for, with types of what is sent and comes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import msgspec

from docs.pages import ROOT
from skillc.contract.api.endpoint import JSON, Endpoint
from skillc.contract.api.endpoints import ENDPOINTS
from skillc.server.http.openapi import name_type

FILE = ROOT / "studio/src/api/requests.ts"
HEAD = """// Made from the endpoints of the contract by `python tests/accept.py`; do not edit.
import type { components } from "./schema";

type Schemas = components["schemas"];

/** What the request of a name has in its path, its query and its body, and what is answered. */
export interface Requests {
"""
MIDDLE = """}

interface Place {
  method: "GET" | "POST" | "PUT" | "DELETE";
  path: string;
  isFile?: true;
}

export const REQUESTS: Record<keyof Requests, Place> = {
"""
TYPES = tuple(kind for each in ENDPOINTS for kind in (each.answer, each.body) if kind not in (None, NoneType))
PLAIN = {str: "string", int: "number", float: "number", bool: "boolean", NoneType: "null"}


def make_requests() -> str:
    """Return the text of the module."""
    types = "".join(line for each in ENDPOINTS for line in _describe(each))
    places = "".join(f"  {each.name}: {_place(each)},\n" for each in ENDPOINTS)
    return f"{HEAD}{types}{MIDDLE}{places}}};\n"


def _describe(endpoint: Endpoint[Any]) -> Iterator[str]:
    """Yield the lines of the type of a request."""
    path = ", ".join(f"{name}: string" for name in endpoint.path_parameters)
    query = "; ".join(_list_query(endpoint.query))
    yield f"  /** {endpoint.summary}. */\n  {endpoint.name}: {{\n    path: [{path}];\n"
    yield f"    query: {f'{{ {query} }}' if query else 'Record<string, never>'};\n"
    yield f"    body: {_name(endpoint.body) if endpoint.body is not None else 'undefined'};\n"
    yield f"    answer: {_name_answer(endpoint)};\n  }};\n"


def _place(endpoint: Endpoint[Any]) -> str:
    file = ", isFile: true" if _is_file(endpoint) else ""
    return f'{{ method: "{endpoint.method}", path: "{endpoint.path}"{file} }}'


def _is_file(endpoint: Endpoint[Any]) -> bool:
    return endpoint.media_types != (JSON,)


def _list_query(query: type[msgspec.Struct]) -> Iterator[str]:
    hints = get_type_hints(query)
    for each in msgspec.structs.fields(query):
        yield f"{each.name}: {_name(hints[each.name])}" if each.required else f"{each.name}?: {_name(hints[each.name])}"


def _name_answer(endpoint: Endpoint[Any]) -> str:
    """Return the type of an answer; the fields that have their defaults are in it, too."""
    if _is_file(endpoint):
        return "ArrayBuffer"
    return "undefined" if endpoint.answer is NoneType else _name(endpoint.answer, complete=True)


def _name(kind: Any, complete: bool = False) -> str:
    """Return a type as TypeScript has it."""
    arguments = get_args(kind)
    if get_origin(kind) in (Union, UnionType):
        return " | ".join(_name(each, complete) for each in arguments)
    if get_origin(kind) is Literal:
        return " | ".join(f'"{each}"' for each in arguments)
    if get_origin(kind) is tuple and arguments[-1] is ...:
        return f"{_name(arguments[0], complete)}[]"
    if get_origin(kind) is tuple:
        return f"[{', '.join(map(_name, arguments))}]"
    if get_origin(kind) is dict:
        return f"Record<string, {_name(arguments[1], complete)}>"
    if kind in PLAIN:
        return PLAIN[kind]
    assert is_dataclass(kind) or issubclass(kind, msgspec.Struct), kind
    schema = f'Schemas["{_name_components()[kind]}"]'
    return f"Required<{schema}>" if complete and not _omits_defaults(kind) else schema


@cache
def _name_components() -> dict[type, str]:
    """Return the names of structs in the OpenAPI document, where two may have the same name in Python."""
    kinds = tuple({each for kind in TYPES for each in _list_structs(kind)})
    schemas, _ = msgspec.json.schema_components((*TYPES, *kinds), ref_template="{name}")
    return {kind: name_type(str(schema["$ref"])) for kind, schema in zip(kinds, schemas[len(TYPES) :], strict=True)}


def _list_structs(kind: Any) -> Iterator[type]:
    if is_dataclass(kind) or (isinstance(kind, type) and issubclass(kind, msgspec.Struct)):
        yield kind
    for each in get_args(kind):
        yield from _list_structs(each)


def _omits_defaults(kind: type) -> bool:
    return issubclass(kind, msgspec.Struct) and kind.__struct_config__.omit_defaults
