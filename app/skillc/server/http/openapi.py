"""The OpenAPI 3.1 document of the server, made of the endpoints and the types of their values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from http import HTTPStatus
from types import NoneType
from typing import Any

import msgspec

from skillc.contract import commands
from skillc.contract.access import NewToken
from skillc.contract.api import endpoints
from skillc.contract.api.endpoint import JSON, Endpoint
from skillc.contract.api.problem import ProblemDetails
from skillc.contract.cell import LeaseRequest, PaceSetting
from skillc.contract.operation import OperationRequest, StopReason
from skillc.contract.order import OrderRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.contract.source import SourceChange
from skillc.contract.world import WorldEdit, WorldPlacement, WorldQuery
from skillc.server.problems import MEDIA_TYPE
from skillc_runtime.devices.disturbances import PushArm

NO_NAMES: Mapping[str, str] = {}


def simplify_arrays(schema: Any, references: Mapping[str, str] = NO_NAMES) -> Any:
    """Return a schema, or a document with schemas, in which arrays of a fixed length have one schema for all items.

    `prefixItems` with `items: false`, which msgspec makes of tuples, stops generators. The lengths stay; if the items
    differ, each may be any of them. `references` are replaced.
    """
    if isinstance(schema, str):
        return references.get(schema, schema)
    if isinstance(schema, list | tuple):
        return [simplify_arrays(each, references) for each in schema]
    if not isinstance(schema, Mapping):
        return schema
    found = {name: simplify_arrays(each, references) for name, each in schema.items() if name != "prefixItems"}
    if isinstance(schema.get("prefixItems"), list | tuple):
        found["items"] = _join(simplify_arrays(schema["prefixItems"], references))
    elif schema.get("items") is False:
        found["items"] = {}
    return found


def name_type(name: str) -> str:
    """Return a name for a type of which others have the same name, `package.module.Type`: `ModuleType`."""
    module, _, kind = name.rpartition(".")
    words = module.rpartition(".")[2].split("_") if module else ()
    return "".join(map(str.capitalize, words)) + kind


def _join(schemas: list[Any]) -> Any:
    different = [each for number, each in enumerate(schemas) if each not in schemas[:number]]
    return different[0] if len(different) == 1 else {"anyOf": different}


_TASK, _SURFACE, _STOP = "clean", {"surface": "lab:Table-1"}, StopReason("a person is in the cell")

EXAMPLES: dict[str, msgspec.Struct] = {
    endpoints.SET_PACE.name: PaceSetting(1.0),
    endpoints.STOP_CELL.name: _STOP,
    endpoints.DISTURB_CELL.name: PushArm("lab:Arm-1", (0.0, 20.0, 0.0)),
    endpoints.TAKE_LEASE.name: LeaseRequest(600.0),
    endpoints.SUBMIT_OPERATION.name: OperationRequest(task=_TASK, arguments=_SURFACE),
    endpoints.GIVE_COMMAND.name: commands.PauseRun("somebody looks at it"),
    endpoints.STOP_OPERATION.name: _STOP,
    endpoints.ADD_ORDER.name: OrderRequest(
        OperationRequest(task=_TASK, arguments=_SURFACE), datetime(2026, 1, 31, 18, tzinfo=UTC), every_s=86_400.0
    ),
    endpoints.QUERY_WORLD.name: WorldQuery("SELECT ?thing WHERE { lab:Table-1 skiros:contain ?thing }"),
    endpoints.EDIT_WORLD.name: WorldEdit(("lab:Table-1 wiping:isClean false",), "it was spilled on"),
    endpoints.PLACE_THING.name: WorldPlacement("lab:Table-1", (0.6, 0.0, 0.4, 1.0, 0.0, 0.0, 0.0), "it was moved"),
    endpoints.ADD_JOB.name: RehearsalRequest(cell="cell", task=_TASK, arguments=_SURFACE),
    endpoints.CHANGE_LIBRARY_SOURCE.name: SourceChange("## Nothing yet.\n", 64 * "0"),
    endpoints.ADD_TOKEN.name: NewToken("line-3", "operate"),
}
OPERATION = "clean-20260131T120000Z-1f0c9a"
PATH_EXAMPLES = {"cell": "cell", "operation": OPERATION, "file": "report.html", "library": "wiping"}


VERSION = "1"
ALWAYS = (
    HTTPStatus.UNAUTHORIZED,
    HTTPStatus.FORBIDDEN,
    HTTPStatus.UNPROCESSABLE_ENTITY,
    HTTPStatus.TOO_MANY_REQUESTS,
    HTTPStatus.SERVICE_UNAVAILABLE,
)
WITH_BODY = (
    HTTPStatus.BAD_REQUEST,
    HTTPStatus.REQUEST_TIMEOUT,
    HTTPStatus.REQUEST_ENTITY_TOO_LARGE,
    HTTPStatus.UNSUPPORTED_MEDIA_TYPE,
)
OPEN = {
    "/health": ("health", "Whether the server answers"),
    "/openapi.json": ("openapi", "This document"),
}
"""The paths that need no token, with their operations and what they are for."""
REF = "#/components/schemas/{name}"
OTHER = "server"
TAGS = {
    "cells": "Cells: how they are, their pace, stops, and what is in them.",
    "lease": "Who may command a cell.",
    "operations": "What cells do and have done, with events, recordings and reports.",
    "orders": "Operations that are submitted at a time.",
    "world": "What a cell knows: facts, queries, edits and their history.",
    "libraries": "The libraries that cells run, and their texts.",
    "jobs": "Work that takes its time: plans, rehearsals in a simulated twin, trials, reports.",
    "session": "Sessions of browsers.",
    "tokens": "Tokens of clients.",
    OTHER: "The server itself.",
}
"""The tags of operations: the last part of a path that is one of these, else OTHER."""
SERVER = {"url": "/", "description": "The server that this document comes from"}
TEXTS = ("text/plain",)
"""The media types of files that are texts; all others are bytes."""


def make_openapi(endpoints: Iterable[Endpoint[Any]], prefix: str) -> dict[str, Any]:
    """Return the document of endpoints below a prefix."""
    endpoints = tuple(endpoints)
    types = [
        each for endpoint in endpoints for each in (endpoint.answer, endpoint.body) if each not in (None, NoneType)
    ]
    schemas, components = msgspec.json.schema_components([*types, ProblemDetails], ref_template=REF)
    schema_of = {id(kind): schema for kind, schema in zip([*types, ProblemDetails], schemas, strict=True)}
    names = {each: name_type(each) for each in components}
    assert len(set(names.values())) == len(names), "no two types have the same name"
    paths: dict[str, dict[str, Any]] = {}
    for each in endpoints:
        paths.setdefault(prefix + each.path, {})[each.method.lower()] = _describe(each, schema_of)
    document = {
        "openapi": "3.1.0",
        "info": {"title": "skillc", "version": VERSION, "description": "Cells that run skills, and their operations."},
        "servers": [SERVER],
        "tags": [{"name": name, "description": about} for name, about in TAGS.items()],
        "security": [{"token": []}],
        "paths": paths | {prefix + path: {"get": _describe_open(*each)} for path, each in OPEN.items()},
        "components": {
            "schemas": {names[each]: {**schema, "title": names[each]} for each, schema in components.items()},
            "securitySchemes": {"token": {"type": "http", "scheme": "bearer"}},
        },
    }
    references = {REF.format(name=each): REF.format(name=name) for each, name in names.items()}
    return dict(simplify_arrays(document, references))


def _describe(endpoint: Endpoint[Any], schema_of: dict[int, dict[str, Any]]) -> dict[str, Any]:
    described: dict[str, Any] = {
        "operationId": endpoint.name,
        "tags": [find_tag(endpoint.path)],
        "summary": endpoint.summary,
        "description": f"Needs the role `{endpoint.role}`.",
        "security": [{"token": [endpoint.role]}],
        "parameters": [*_path_parameters(endpoint), *_query_parameters(endpoint), *_header_parameters(endpoint)],
        "responses": _responses(endpoint, schema_of),
    }
    if endpoint.body is not None:
        content: dict[str, Any] = {JSON: {"schema": schema_of[id(endpoint.body)]}}
        if endpoint.name in EXAMPLES:
            content[JSON]["example"] = msgspec.to_builtins(EXAMPLES[endpoint.name])
        described["requestBody"] = {"required": endpoint.needs_body, "content": content}
    return described


def _describe_open(operation: str, summary: str) -> dict[str, Any]:
    answer = {"description": HTTPStatus.OK.phrase, "content": {JSON: {"schema": {"type": "object"}}}}
    return {
        "operationId": operation,
        "tags": [OTHER],
        "summary": summary,
        "security": [],
        "responses": {"200": answer},
    }


def find_tag(path: str) -> str:
    """Return the tag of the operations of a path."""
    return next((part for part in reversed(path.split("/")) if part in TAGS), OTHER)


def _responses(endpoint: Endpoint[Any], schema_of: dict[int, dict[str, Any]]) -> dict[str, Any]:
    success: dict[str, Any] = {"description": endpoint.status.phrase}
    if endpoint.answer is not NoneType:
        success["content"] = {JSON: {"schema": schema_of[id(endpoint.answer)]}}
    elif endpoint.media_types != (JSON,):
        success["content"] = {each: {"schema": _describe_file(each)} for each in endpoint.media_types}
    refused = {*ALWAYS, *endpoint.refusals, *(WITH_BODY if endpoint.body is not None else ())}
    if endpoint.takes_key:
        refused.add(HTTPStatus.BAD_REQUEST)
    problem = {MEDIA_TYPE: {"schema": schema_of[id(ProblemDetails)]}}
    problems = {str(each.value): {"description": each.phrase, "content": problem} for each in sorted(refused)}
    return {str(endpoint.status.value): success, **problems}


def _describe_file(media_type: str) -> dict[str, Any]:
    return {"type": "string"} if media_type in TEXTS else {"type": "string", "format": "binary"}


def _path_parameters(endpoint: Endpoint[Any]) -> list[dict[str, Any]]:
    return [
        {"name": name, "in": "path", "required": True, "schema": {"type": "string"}, **_example_of(name)}
        for name in endpoint.path_parameters
    ]


def _example_of(parameter: str) -> dict[str, str]:
    return {"example": PATH_EXAMPLES[parameter]} if parameter in PATH_EXAMPLES else {}


def _query_parameters(endpoint: Endpoint[Any]) -> list[dict[str, Any]]:
    _, components = msgspec.json.schema_components([endpoint.query], ref_template=REF)
    schema = components[endpoint.query.__name__]
    properties, required = schema.get("properties", {}), schema.get("required", ())
    return [
        {"name": name, "in": "query", "required": name in required, "schema": each} for name, each in properties.items()
    ]


def _header_parameters(endpoint: Endpoint[Any]) -> list[dict[str, Any]]:
    if not endpoint.takes_key:
        return []
    schema = {"type": "string", "minLength": 1, "maxLength": 200, "pattern": "^[ -~]+$"}
    return [{"name": "Idempotency-Key", "in": "header", "required": False, "schema": schema}]
