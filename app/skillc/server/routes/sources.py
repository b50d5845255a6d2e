"""The texts of libraries: which there are, what they say, and changing them."""

from __future__ import annotations

import asyncio
from http import HTTPStatus

from skillc.contract.source import SourceInfo, SourceText
from skillc.errors import ServiceError
from skillc.server.http.api_call import ApiCall
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
