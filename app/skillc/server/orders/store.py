"""The orders in the database of a server."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable

import msgspec

from skillc.contract.order import Order, OrderRequest
from skillc.server.orders.due import find_time

TABLE = """
CREATE TABLE orders (
    number    INTEGER PRIMARY KEY AUTOINCREMENT,
    id        TEXT NOT NULL UNIQUE,
    cell      TEXT NOT NULL,
    owner     TEXT NOT NULL,                   -- the name of a token
    request   BLOB NOT NULL,                   -- an OrderRequest as JSON
    next      INTEGER NOT NULL,                -- the number of the next operation, counted from 0
    ended     INTEGER NOT NULL,                -- whether there is no further one
    operation TEXT,                            -- the last operation that was submitted
    reason    TEXT NOT NULL                    -- why the last one that was due was not; empty otherwise
)
"""
MAX_ORDERS = 1000
"""How many orders that have not ended a server keeps."""
KEPT = 100
"""How many orders that have ended are kept."""
COLUMNS = "SELECT id, cell, owner, request, operation, reason, next FROM orders"


class TooManyOrders(Exception):
    """The server keeps no more orders."""


class Orders:
    """The orders of a server. What a method has changed is durable when it returns."""

    def __init__(self, database: sqlite3.Connection) -> None:
        self._database = database

    def add(self, name: str, cell: str, owner: str, request: OrderRequest) -> None:
        """Add an order. TooManyOrders if there are as many as possible."""
        (count,) = self._database.execute("SELECT count(*) FROM orders WHERE NOT ended").fetchone()
        if count >= MAX_ORDERS:
            raise TooManyOrders(f"there are {MAX_ORDERS} orders that have not ended; remove some")
        row = (name, cell, owner, msgspec.json.encode(request))
        query = "INSERT INTO orders (id, cell, owner, request, next, ended, reason) VALUES (?, ?, ?, ?, 0, 0, '')"
        self._database.execute(query, row)

    def find(self, name: str) -> Order | None:
        """Return an order; None if there is none of this id."""
        return next((each for each, _ in self._read(self._database.execute(f"{COLUMNS} WHERE id = ?", (name,)))), None)

    def list(self, cell: str) -> tuple[Order, ...]:
        """Return the orders for a cell, in the order of their submission."""
        rows = self._database.execute(f"{COLUMNS} WHERE cell = ? ORDER BY number", (cell,))
        return tuple(each for each, _ in self._read(rows))

    def list_open(self, cell: str) -> tuple[tuple[Order, int], ...]:
        """Return the orders for a cell that have not ended, each with the number of its next operation."""
        rows = self._database.execute(f"{COLUMNS} WHERE cell = ? AND NOT ended ORDER BY number", (cell,))
        return tuple(self._read(rows))

    def remove(self, name: str) -> None:
        """Remove an order, if it exists."""
        self._database.execute("DELETE FROM orders WHERE id = ?", (name,))

    def pass_on(self, order: Order, number: int, operation: str | None, reason: str) -> None:
        """Note that operation `number` of an order was submitted, or why not; no earlier one will be."""
        ended = find_time(order.order, number + 1) is None
        query = "UPDATE orders SET next = ?, ended = ?, operation = coalesce(?, operation), reason = ? WHERE id = ?"
        self._database.execute(query, (number + 1, ended, operation, reason, order.id))
        kept = "SELECT number FROM orders WHERE ended ORDER BY number DESC LIMIT ?"
        self._database.execute(f"DELETE FROM orders WHERE ended AND number NOT IN ({kept})", (KEPT,))

    def wait(self, order: Order, reason: str) -> None:
        """Note why an operation that is due waits."""
        if order.reason != reason:
            self._database.execute("UPDATE orders SET reason = ? WHERE id = ?", (reason, order.id))

    def _read(self, rows: Iterable[tuple[str, str, str, bytes, str | None, str, int]]) -> Iterable[tuple[Order, int]]:
        for name, cell, owner, request, operation, reason, number in rows:
            wanted = msgspec.json.decode(request, type=OrderRequest)
            yield Order(name, cell, owner, wanted, find_time(wanted, number), operation, reason), number
