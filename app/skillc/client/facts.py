"""Reads all facts that are asked for, page by page."""

from __future__ import annotations

from skillc.client.connection import Connection
from skillc.contract.api.endpoints import LIST_FACTS
from skillc.contract.world import FactPage, WorldFact

PAGE = 1000


async def collect_facts(
    connection: Connection, cell: str, subject: str | None, type: str | None, search: str | None
) -> tuple[WorldFact, ...]:
    """Return the facts of the world of a cell; the parameters are those of `AsyncCell.facts`."""
    found: list[WorldFact] = []
    while True:
        page = await connection.call(LIST_FACTS, cell, query=FactPage(subject, type, search, len(found), PAGE))
        found += page.facts
        if len(found) >= page.total or not page.facts:
            return tuple(found)
