"""What can be read of a tree during and after its run: the status of its nodes, active calls, what calls claim."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.execution.success_facts import Claim
from skillc_runtime.execution.tree.calls.call_node import CallNode
from skillc_runtime.execution.tree.node import RUNNING, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.history.node_outcome import NodeOutcome


def collect_outcome(node: Node) -> NodeOutcome:
    """Return the status of a node and of all its descendants, during or after the run."""
    return NodeOutcome(
        id=node.id,
        name=node.name,
        kind=node.kind,
        status=node.status.value,
        source=node.source,
        started=node.started,
        ended=node.ended,
        failure=node.failure,
        rejected=tuple(node.rejected) if isinstance(node, CallNode) else (),
        children=tuple(collect_outcome(child) for child in node.children),
    )


def find_active_calls(node: Node) -> Iterator[CallNode]:
    """Yield the innermost calls below a node that run or wait, in the order of the tree."""
    below = [call for child in node.children if child.status is RUNNING for call in find_active_calls(child)]
    yield from below or ((node,) if isinstance(node, CallNode) and node.status is RUNNING else ())


def collect_claims(node: Node) -> Iterator[Claim]:
    """Yield the posts of the outermost calls below a node that succeeded, with the values of their variables."""
    if not isinstance(node, CallNode):
        for child in node.children:
            yield from collect_claims(child)
    elif node.activation is not None and node.status is Status.SUCCESS:
        frame = dict(node.activation.frame)
        yield from ((post.condition, frame) for post in node.activation.implementation.post)
        yield from ((each.condition, frame) for each in node.activation.find_true_outcomes())
