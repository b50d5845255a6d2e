"""What the endpoints of a server share: its state, its cells, and who listens to events."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import closing
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import partial
from http import HTTPStatus

from skillc.cells.journal.reading import JournalReader
from skillc.contract.operation import OperationStatus
from skillc.server.access.audit import AuditLog
from skillc.server.access.codes import LoginCodes
from skillc.server.access.leases import Leases
from skillc.server.access.rates import TokenBuckets
from skillc.server.access.watchers import Watchers
from skillc.server.hub import EventHub
from skillc.server.idempotency import RequestKeys
from skillc.server.jobs.running import Jobs, Lane, LaneName
from skillc.server.jobs.store import JobStore
from skillc.server.metrics import Metrics
from skillc.server.orders.store import Orders
from skillc.server.problems import ApiRefusal
from skillc.server.served_library import ServedLibrary
from skillc.server.state import JOB_FILES, ServerState
from skillc.server.supervisor import CellSupervisor
from skillc.workers.pool import Workers

FAILURES_PER_S, FAILURES = 0.2, 100.0
"""How many requests and WebSockets without a valid token an address may make."""
MAX_OF_CLIENT, MAX_SERVERS = 4, 8
"""How many language servers a client has, and how many there are; each is a process."""

MAX_PLANS, MAX_SIMULATIONS = 20, 8
"""How many plans, and how many jobs that simulate, wait or are made."""


def _one_worker() -> Workers:
    return Workers(count=1)


def _now_utc() -> datetime:
    return datetime.now(UTC)


@dataclass(frozen=True, slots=True)
class ServerContext:
    """A running server; `clock` is that by which orders are due."""

    state: ServerState
    cells: dict[str, CellSupervisor]
    hub: EventHub
    libraries: tuple[ServedLibrary, ...] = ()
    leases: Leases = field(default_factory=Leases)
    codes: LoginCodes = field(default_factory=LoginCodes)
    failures: TokenBuckets = field(default_factory=lambda: TokenBuckets(FAILURES_PER_S, FAILURES))
    workers: Workers = field(default_factory=Workers)
    jobs: Jobs = field(init=False)
    run_readers: Workers = field(default_factory=Workers)
    watchers: Watchers = field(default_factory=Watchers)
    language_servers: Watchers = field(
        default_factory=partial(Watchers, "language servers", MAX_OF_CLIENT, MAX_SERVERS)
    )
    clock: Callable[[], datetime] = _now_utc
    audit: AuditLog = field(init=False)
    keys: RequestKeys = field(init=False)
    orders: Orders = field(init=False)
    metrics: Metrics = field(init=False)

    def __post_init__(self) -> None:
        lanes: dict[LaneName, Lane] = {
            "plans": Lane.of(self.workers, MAX_PLANS),
            "simulations": Lane.of(_one_worker(), MAX_SIMULATIONS),
            "trials": Lane.of(_one_worker(), MAX_SIMULATIONS),
        }
        jobs = Jobs(JobStore(self.state.database), self.state.folder / JOB_FILES, lanes, self.hub.publish)
        object.__setattr__(self, "jobs", jobs)
        object.__setattr__(self, "audit", AuditLog(self.state.database))
        object.__setattr__(self, "keys", RequestKeys(self.state.database))
        object.__setattr__(self, "orders", Orders(self.state.database))
        object.__setattr__(self, "metrics", Metrics(self.cells.values(), lambda: self.hub.count))

    def find_users(self, library: ServedLibrary) -> tuple[CellSupervisor, ...]:
        """Return the cells that run a library."""
        return tuple(each for each in self.cells.values() if each.settings.library == library.path)

    def library_of(self, cell: CellSupervisor) -> ServedLibrary:
        """Return the library that a cell runs."""
        return next(each for each in self.libraries if each.path == cell.settings.library)

    def find_library(self, name: str) -> ServedLibrary:
        """Return a library; ApiRefusal (404) if there is none of this name."""
        found = {each.checked.name: each for each in reversed(self.libraries)}
        if name not in found:
            raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no library `{name}`; there is {_join(found)}")
        return found[name]

    def find_cell(self, name: str | None) -> CellSupervisor:
        """Return a cell, the only one without a name; ApiRefusal (404) if there is none of this name, or several."""
        if name is None and len(self.cells) == 1:
            return next(iter(self.cells.values()))
        if name is None:
            raise ApiRefusal(HTTPStatus.NOT_FOUND, f"name the cell; there is {_join(self.cells)}")
        if name not in self.cells:
            raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no cell `{name}`; there is {_join(self.cells)}")
        return self.cells[name]

    def find_operation(self, name: str) -> tuple[CellSupervisor, OperationStatus]:
        """Return an operation as it is, with its cell; ApiRefusal (404) if there is none of this id.

        ApiRefusal (503) for one that was interrupted, until its cell has started again and written how it ended.
        """
        for cell in self.cells.values():
            if (operation := cell.operations.get(name) or _find_ended(cell, name)) is not None:
                return cell, operation
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no operation `{name}`")

    def has_operation(self, name: str) -> bool:
        """Whether an operation was submitted; one that was interrupted, too, before its cell has started again."""
        try:
            self.find_operation(name)
        except ApiRefusal as refused:
            return refused.status is not HTTPStatus.NOT_FOUND
        return True


def open_journal(cell: CellSupervisor) -> JournalReader:
    """Open the journal of a cell; DatabaseError if it cannot be read, because the cell has never been ready."""
    return JournalReader(cell.settings.journal)


def _find_ended(cell: CellSupervisor, name: str) -> OperationStatus | None:
    if not cell.settings.journal.exists():
        return None
    with closing(open_journal(cell)) as reader:
        found = reader.find(name)
    if found is not None and found.ended is None:
        raise ApiRefusal(
            HTTPStatus.SERVICE_UNAVAILABLE, f"{cell.settings.name} is {cell.status.state}: {cell.status.reason}"
        )
    return found.ended if found else None


def _join(names: Iterable[str]) -> str:
    return ", ".join(f"`{each}`" for each in sorted(names)) or "none"
