"""Which operations and events are asked for, and the events that come."""

from __future__ import annotations

from typing import Annotated

import msgspec

Limit = Annotated[int, msgspec.Meta(ge=1, le=1000)]


class HistoryPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which part of a history: what was submitted before a wall time, in ns since 1970, and how much at most.

    With `search` only those in which these words occur: in the id, in what was requested and by whom, or in how it
    ended. `ongoing` for all operations that have not ended instead, in the order of their submission.
    """

    before_ns: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] | None = None
    limit: Limit = 100
    search: Annotated[str, msgspec.Meta(max_length=200)] = ""
    ongoing: bool = False


class EventPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which events: those after a number, and how many at most."""

    after: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    limit: Limit = 1000


class EventsHello(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The first message of a client, as JSON: its token, and the operation whose events it wants, after a number.

    Without an operation it gets how cells and operations are. A page has the cookie of a session instead of a token.
    """

    token: Annotated[str, msgspec.Meta(max_length=200)] | None = None
    operation: Annotated[str, msgspec.Meta(max_length=200)] | None = None
    after: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
