"""A server; made from `async_server` by `python tests/accept.py`, not edited."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.client.cell import ServerCell
from skillc.client.feed import Status
from skillc.client.operation import ServerOperation
from skillc.client.waiting import WaitingServer
from skillc.contract.access import Role, TokenInfo
from skillc.contract.api.version import VersionInfo
from skillc.contract.audit import AuditEntry
from skillc.contract.cell import CellStatus
from skillc.contract.job import Job, JobEvent, JobResult
from skillc.contract.library import LibraryStatus
from skillc.contract.source import SourceInfo, SourceText


class Server(WaitingServer):
    """A server; its methods are those of `AsyncServer`, and wait. They may be called from any thread.

    As a context manager it closes the connection; what goes on in the server goes on.
    """

    def cells(self) -> tuple[CellStatus, ...]:
        """List the cells."""
        return self._loop.run(self._client.cells())

    def version(self) -> VersionInfo:
        """Show the versions of skillc and of the API."""
        return self._loop.run(self._client.version())

    def libraries(self) -> tuple[LibraryStatus, ...]:
        """List the libraries, and why the one on disk is not used."""
        return self._loop.run(self._client.libraries())

    def jobs(self, cell: str | None = None) -> tuple[Job, ...]:
        """List the jobs of all cells, or of one.

        Which jobs: those of a cell, or of all.
        """
        return self._loop.run(self._client.jobs(cell))

    def job(self, job: str) -> Job:
        """Show a job."""
        return self._loop.run(self._client.job(job))

    def job_result(self, job: str) -> JobResult:
        """Show what came of a job; of trials also while they go on."""
        return self._loop.run(self._client.job_result(job))

    def job_events(self, job: str, after: int = 0, wait_s: float = 0.0) -> tuple[JobEvent, ...]:
        """Read the log of a job, or wait for its next line.

        Which lines of a log: those after a number. If there are none yet, they are waited for, `wait_s` s at most.
        """
        return self._loop.run(self._client.job_events(job, after, wait_s))

    def cancel_job(self, job: str) -> Job:
        """End a job that goes on; nothing happens to others."""
        return self._loop.run(self._client.cancel_job(job))

    def restart_job(self, job: str) -> Job:
        """Begin a job again that failed, was cancelled or interrupted; trials go on with those that are missing."""
        return self._loop.run(self._client.restart_job(job))

    def remove_job(self, job: str) -> None:
        """End and forget a job, with its log, its result and its files."""
        self._loop.run(self._client.remove_job(job))

    def list_library_sources(self, library: str) -> tuple[SourceInfo, ...]:
        """List the texts of a library, and those that it may import."""
        return self._loop.run(self._client.list_library_sources(library))

    def read_library_source(self, library: str, path: str) -> SourceText:
        """Read a text of a library.

        Which text, by its path in the library.
        """
        return self._loop.run(self._client.read_library_source(library, path))

    def change_library_source(self, library: str, path: str, text: str, base_hash: str) -> SourceText:
        """Change a text of a library, unless somebody else has meanwhile.

        Which text, by its path in the library.

        A new text, in the place of the one whose file has the hash `base_hash`.
        """
        return self._loop.run(self._client.change_library_source(library, path, text, base_hash))

    def tokens(self) -> tuple[TokenInfo, ...]:
        """List the tokens."""
        return self._loop.run(self._client.tokens())

    def revoke_token(self, name: str) -> None:
        """Revoke a token."""
        self._loop.run(self._client.revoke_token(name))

    def list_audit_entries(self, after: int = 0, limit: int = 1000) -> tuple[AuditEntry, ...]:
        """Read the audit log: what was changed, by whom, and what was refused.

        Which entries: those after a number, and how many at most.
        """
        return self._loop.run(self._client.list_audit_entries(after, limit))

    def cell(self, name: str | None = None) -> ServerCell:
        """Return a cell, or the only one. RequestError, with the cells, if there is none such, or several."""
        return ServerCell(self._loop, self._loop.run(self._client.cell(name)))

    def operation(self, id: str | None = None) -> ServerOperation:
        """Return an operation, or the only one that goes on. RequestError if there is none such, or several."""
        return ServerOperation(self._loop, self._loop.run(self._client.operation(id)))

    def ongoing(self) -> tuple[ServerOperation, ...]:
        """Return the operations of all cells that have not ended."""
        return tuple(ServerOperation(self._loop, each) for each in self._loop.run(self._client.ongoing()))

    def watch(self) -> Iterator[Status]:
        """Yield how each cell and each operation that goes on is, and then what changes, until that is given up.

        Of several changes of the same only the last one may come; events of operations come all.
        """
        return self._loop.iterate(self._client.watch())

    def add_token(self, name: str, role: Role, agent: bool = False) -> str:
        """Make a token for a client, and return it; nobody can read it again.

        What an `agent`, a program that decides by itself, submits waits for the approval of somebody else.
        """
        return self._loop.run(self._client.add_token(name, role, agent))

    def make_login_code(self) -> str:
        """Return a code that stands for the token of this client in one request, within a minute."""
        return self._loop.run(self._client.make_login_code())
