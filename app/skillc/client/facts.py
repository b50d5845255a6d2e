"""Reads all facts that are asked for, page by page."""

from __future__ import annotations

from skillc.client.connection import Connection
from skillc.contract.world import WorldFact, WorldFacts

PAGE = 1000


async def collect_facts(
    connection: Connection, path: str, subject: str | None, type: str | None, search: str | None
) -> tuple[WorldFact, ...]:
    """Return the facts at a path of the API; the parameters are those of `AsyncCell.facts`."""
    found: list[WorldFact] = []
    while True:
        page = await connection.get(
            path, WorldFacts, subject=subject, type=type, search=search, offset=len(found), limit=PAGE
        )
        found += page.facts
        if len(found) >= page.total or not page.facts:
            return tuple(found)
