"""The tree of a run: all nodes of its bodies, also those that have not started, numbered as in its events."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from msgspec import structs

from skillc.contract.runs.run_tree import OperationTree, TreeNode
from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.skills import Compound, SkillLibrary
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.execution.plans.plan_record import restore_arrangement, restore_steps
from skillc_runtime.execution.tree.outline import OutlinedNode, outline_body
from skillc_runtime.planning.plan import Plan
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import (
    ImplementationChosen,
    NodeStarted,
    PlanArrived,
    PlanMade,
    Replanned,
    TaskStarted,
)
from skillc_runtime.recording.recorded_plan import ArrivedPlan


def build_tree(envelopes: Iterable[Envelope], library: SkillLibrary) -> OperationTree:
    """Return the tree of a run after some events, which runs skills of a library."""
    builder = _TreeBuilder(library)
    for each in envelopes:
        builder.add(each)
    return OperationTree(builder.sequence, tuple(builder.list_nodes()))


@dataclass(slots=True)
class _TreeBuilder:
    """Collects nodes by their number; the children of each are in order.

    `roots` has the root of each attempt. `body` is that of the attempt whose root has not started yet. `chosen` is what
    a call has chosen whose body has not started yet.
    """

    library: SkillLibrary
    sequence: int = 0
    roots: list[int] = field(default_factory=list)
    nodes: dict[int, TreeNode] = field(default_factory=dict)
    children: dict[int, list[int]] = field(default_factory=dict)
    body: tree.Node | None = None
    chosen: dict[int, tree.Node] = field(default_factory=dict)

    def add(self, envelope: Envelope) -> None:
        """Take an event into account."""
        self.sequence = envelope.sequence
        match envelope.event:
            case TaskStarted(body=body):
                self.body = body
            case PlanArrived(plan=plan) if plan is not None:
                self._plan(plan)
            case PlanMade() as plan:
                self._plan(plan)
            case Replanned():
                self.body = None
            case ImplementationChosen() as choice:
                self._choose(choice)
            case NodeStarted() as start if start.parent == 0 and self.body is not None:
                self._begin_attempt(self.body, start.node)
            case NodeStarted() as start if start.parent in self.chosen:
                self._add_body(self.chosen.pop(start.parent), start.node, start.parent)
            case NodeStarted() as start:
                self._start(start)
            case _:
                pass

    def list_nodes(self) -> Iterator[TreeNode]:
        """Yield all nodes, those of an attempt that has not started last: with the numbers that they will have."""
        for root in self.roots:
            yield from self._list_below(root)
        if self.body is not None:
            before = max(self.nodes, default=0)
            yield from self._make_nodes(outline_body(self.body, self.library, before), 0, len(self.roots) + 1)

    def _plan(self, plan: ArrivedPlan | PlanMade) -> None:
        steps = Plan(restore_steps(plan.steps), 0.0)
        self.body = build_plan_body(steps, restore_arrangement(plan.arrangement), self.library, plan.space)

    def _choose(self, choice: ImplementationChosen) -> None:
        """Note what a call has chosen; it has one body at a time, that of its last choice."""
        for child in self.children.pop(choice.node, ()):
            self._remove(child)
        if choice.node in self.nodes:
            chosen = structs.replace(self.nodes[choice.node], implementation=choice.implementation)
            self.nodes[choice.node] = chosen
        implementation = self.library.implementations.get(f"{choice.skill}.{choice.implementation}")
        if implementation is not None and isinstance(implementation.body, Compound):
            self.chosen[choice.node] = implementation.body.node

    def _begin_attempt(self, body: tree.Node, root: int) -> None:
        self.body = None
        self.roots.append(root)
        self._add_body(body, root, 0)

    def _add_body(self, body: tree.Node, root: int, parent: int) -> None:
        """Add the nodes of a body whose root has the number `root`, the highest one."""
        outlined = outline_body(body, self.library)
        outlined = outline_body(body, self.library, root - outlined[0].id)
        for each in self._make_nodes(outlined, parent, len(self.roots)):
            self._add(each)

    def _make_nodes(self, outlined: Sequence[OutlinedNode], parent: int, attempt: int) -> Iterator[TreeNode]:
        for each in outlined:
            yield TreeNode(
                id=each.id,
                parent=each.parent or parent,
                attempt=attempt,
                kind=each.kind,
                label=each.name,
                source=each.source,
                skill=each.call.skill if each.call is not None else "",
                arguments=self._format_arguments(each.call) if each.call is not None else {},
            )

    def _format_arguments(self, call: tree.Call) -> dict[str, str]:
        short = self.library.vocabulary.short
        return {name: short(each.iri) for name, each in call.arguments.items() if isinstance(each, Individual)}

    def _start(self, start: NodeStarted) -> None:
        """Add a node that no body has: the primitive of a call; the others only have their names now."""
        known = self.nodes.get(start.node)
        if known is None:
            node = TreeNode(
                id=start.node,
                parent=start.parent,
                attempt=len(self.roots),
                kind=start.kind,
                label=start.name,
                source=start.source,
            )
            self._add(node)

    def _add(self, node: TreeNode) -> None:
        self.nodes[node.id] = node
        if node.parent:
            self.children.setdefault(node.parent, []).append(node.id)

    def _remove(self, node: int) -> None:
        self.nodes.pop(node, None)
        for child in self.children.pop(node, ()):
            self._remove(child)

    def _list_below(self, node: int) -> Iterator[TreeNode]:
        yield self.nodes[node]
        for child in self.children.get(node, ()):
            yield from self._list_below(child)
