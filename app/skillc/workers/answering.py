"""What workers do: one piece of work after the other, each for a snapshot of a cell."""

from __future__ import annotations

import msgspec

from skillc.cells.database import DatabaseError
from skillc.cells.snapshot import decode_snapshot
from skillc.contract.diagnosis import WorkRefused
from skillc.errors import DiagnosticsError, ServiceError
from skillc.services.reporting.diagnosis import diagnose
from skillc.services.views import scenes  # noqa: F401  most of what is asked needs it, and a start does not count
from skillc.workers.questions import Work
from skillc_runtime.scene.query import QueryError
from skillc_runtime.world.state.names import NoSuchName


def answer_work(request: tuple[Work, bytes] | None) -> bytes | WorkRefused:
    """Return what comes of work for an encoded snapshot, as JSON, or why nothing does; None asks if it is ready."""
    if request is None:
        return b""
    work, snapshot = request
    try:
        return msgspec.json.encode(work(decode_snapshot(snapshot)) if snapshot else work())
    except DiagnosticsError as error:
        return WorkRefused(diagnosis=diagnose(error))
    except (ServiceError, QueryError, NoSuchName, DatabaseError) as error:
        return WorkRefused(str(error))
    except MemoryError:
        return WorkRefused("it needs too much memory; ask for less")
