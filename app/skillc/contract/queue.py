"""The queue of a cell: the order of the operations that wait in it."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import msgspec

OperationId: TypeAlias = Annotated[str, msgspec.Meta(max_length=200)]


class QueueOrder(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The ids of the operations that come first among those that wait in a cell, in this order."""

    first: Annotated[tuple[OperationId, ...], msgspec.Meta(min_length=1, max_length=200)]
