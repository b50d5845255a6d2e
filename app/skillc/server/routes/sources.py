"""The texts of libraries: which there are, what they say, and changing them."""

from __future__ import annotations

import asyncio
from http import HTTPStatus

from skillc.contract.source import SourceChange, SourceInfo, SourcePath, SourceText
from skillc.errors import ServiceError
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.library_sources import NotEditable, SourceChanged, list_sources, read_source, write_source
from skillc.server.problems import ApiRefusal


async def list_library_sources(call: ApiCall) -> tuple[SourceInfo, ...]:
    found = await asyncio.to_thread(list_sources, call.server.find_library(call.path["library"]))
    return tuple(SourceInfo(path, each.editable) for path, each in sorted(found.items()))


async def read_library_source(call: ApiCall) -> SourceText:
    library = call.server.find_library(call.path["library"])
    try:
        return await asyncio.to_thread(lambda: read_source(list_sources(library), call.query.path))
    except ServiceError as error:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, str(error)) from error


async def change_library_source(call: ApiCall) -> SourceText:
    library, change = call.server.find_library(call.path["library"]), call.body
    try:
        async with library.writing:  # waits for the write of somebody else to the disk
            written = await asyncio.to_thread(
                lambda: write_source(list_sources(library), call.query.path, change.text, change.base_hash)
            )
    except SourceChanged as error:
        raise ApiRefusal(HTTPStatus.PRECONDITION_FAILED, str(error)) from error
    except NotEditable as error:
        raise ApiRefusal(HTTPStatus.CONFLICT, str(error)) from error
    except ServiceError as error:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, str(error)) from error
    library.touched = True
    return written


NOT_FOUND = HTTPStatus.NOT_FOUND
PATH = "/libraries/{library}/files"
ENDPOINTS = (
    ApiEndpoint(
        "GET", PATH, "view", "List the texts of a library, and those that it may import", list_library_sources,
        tuple[SourceInfo, ...], refusals=(NOT_FOUND,),
    ),
    ApiEndpoint(
        "GET", "/libraries/{library}/file", "view", "Read a text of a library", read_library_source, SourceText,
        query=SourcePath, refusals=(NOT_FOUND,),
    ),
    ApiEndpoint(
        "PUT", "/libraries/{library}/file", "edit", "Change a text of a library, unless somebody else has meanwhile",
        change_library_source, SourceText, body=SourceChange, query=SourcePath,
        refusals=(NOT_FOUND, HTTPStatus.CONFLICT, HTTPStatus.PRECONDITION_FAILED),
    ),
)  # fmt: skip
