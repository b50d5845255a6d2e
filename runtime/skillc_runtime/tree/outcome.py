"""What became of the nodes of a run."""

from __future__ import annotations

from skillc_runtime.recording.outcome import Outcome
from skillc_runtime.tree.call import CallNode
from skillc_runtime.tree.node import Node


def outcome(node: Node) -> Outcome:
    """Return the node and all below it as a value, now or after the run."""
    return Outcome(
        id=node.id,
        name=node.name,
        kind=node.kind,
        status=node.status.value,
        source=node.source,
        started=node.started,
        ended=node.ended,
        failure=node.failure,
        rejected=tuple(node.rejected) if isinstance(node, CallNode) else (),
        children=tuple(outcome(child) for child in node.children),
    )
