"""Connects a cell of a server with its topics: publishes what the server sends, and passes orders on."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import TimeoutError as Late
from contextlib import aclosing
from functools import partial
from typing import Any

import msgspec
from msgspec import structs

from skillc.client.async_cell import AsyncCell
from skillc.client.async_server import AsyncServer
from skillc.contract.cell import CellStatus
from skillc.contract.geometry import CellModel
from skillc.contract.operation import ENDS, OperationStatus
from skillc.contract.sample import Sample
from skillc.errors import SkillcError
from skillc.events import Event, NodeEnded, NodeStarted
from skillc.ros.messages import joint_state, markers, wrench
from skillc.ros.orders import CellOrder, OrderAnswer, Word, carry_out, read_order
from skillc_runtime.backends.ros2.session import find_message, plain_name

SERVICES: tuple[Word, ...] = ("start", "pause", "resume", "stop", "acknowledge")
MARKERS_EVERY = 5
"""Every how many samples markers are published: RViz needs no more."""

PERIOD_S = 0.2
"""How often a tree that changes is published at most, in s."""


class StartedNodes:
    """The nodes of one operation; call it in an event loop, whose time decides when they are published."""

    def __init__(self, operation: str, publish: Callable[[bytes], None]) -> None:
        self._operation, self._publish = operation, publish
        self._nodes: dict[int, dict[str, Any]] = {}
        self._loop, self._due_s = asyncio.get_running_loop(), 0.0
        self._later: asyncio.TimerHandle | None = None

    def take(self, event: Event) -> None:
        """Take what has happened; a change is published at once, or when a period is over since the last one."""
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind, name=name):
                self._nodes[node] = {"id": node, "parent": parent, "kind": kind, "name": name, "status": "running"}
            case NodeEnded(node=node, status=ended) if node in self._nodes:
                self._nodes[node]["status"] = ended
            case _:
                return
        if self._later is None:
            self._later = self._loop.call_at(max(self._due_s, self._loop.time()), self.show)

    def show(self) -> None:
        """Publish the nodes as they are now."""
        self.close()
        self._due_s = self._loop.time() + PERIOD_S
        self._publish(msgspec.json.encode({"operation": self._operation, "nodes": list(self._nodes.values())}))

    def close(self) -> None:
        """Publish no change any more that is waiting for its time."""
        if self._later is not None:
            self._later.cancel()
            self._later = None


RATE_HZ = 50.0
ANSWER_S = 20.0
"""How long an order may take, in s; it is not withdrawn then."""
JOINT_NAMES = """
PREFIX skillc: <https://w3id.org/skillc/core#>
PREFIX ros2: <https://w3id.org/skillc/ros2#>
SELECT ?arm ?names WHERE {
    { ?arm ros2:jointNames ?names } UNION { ?arm skillc:hasSheet ?sheet . ?sheet ros2:jointNames ?names }
}
"""


class CellBridge:
    """One cell; all but `order` is called in the event loop."""

    def __init__(self, node: Any, server: AsyncServer, cell: AsyncCell) -> None:
        self._server, self._cell, self._loop = server, cell, asyncio.get_running_loop()
        self._topics = CellTopics(node, cell.name, self.order)
        self._status: CellStatus | None = None
        self._operations: dict[str, OperationStatus] = {}
        self._followed: dict[str, asyncio.Task[None]] = {}

    def order(self, order: CellOrder | str) -> OrderAnswer:
        """Carry out an order and wait for that; called by threads of the node."""
        found = read_order(order) if isinstance(order, str) else order
        if isinstance(found, OrderAnswer):
            return found
        future = asyncio.run_coroutine_threadsafe(carry_out(found, self._cell), self._loop)
        try:
            return future.result(ANSWER_S)
        except Late:
            return OrderAnswer(False, f"the server has not answered within {ANSWER_S:g} s", found.operation, found.id)

    async def show_motion(self) -> None:
        """Publish what the cell can do, and then joints, wrenches and markers until the server ends."""
        self._topics.publish_text("library", msgspec.json.encode(await self._cell.library()))
        model, still = await self._cell.model(), await self._cell.poses()
        names = {arm: tuple(map(_plain_joint, each.joints)) for arm, each in model.arms.items()}
        names |= await self._find_names({model.individuals[arm].label: arm for arm in model.arms})
        async with aclosing(self._cell.samples(RATE_HZ)) as samples:
            async for sample in samples:
                self._topics.show(structs.replace(sample, things=still | sample.things), model, names)

    def take(self, status: CellStatus | OperationStatus) -> None:
        """Publish how the cell is now, and follow the tree of each operation that goes on."""
        match status:
            case CellStatus():
                self._status = status
            case OperationStatus(state=state) if state in ENDS:
                self._operations.pop(status.id, None)
            case OperationStatus():
                self._operations[status.id] = status
                if status.id not in self._followed:
                    self._followed[status.id] = asyncio.create_task(self._follow(status))
        self._topics.publish_text("status", msgspec.json.encode(self._describe(status)))

    def close(self) -> None:
        """Follow no operation any more."""
        for task in self._followed.values():
            task.cancel()

    def _describe(self, last: CellStatus | OperationStatus) -> dict[str, Any]:
        cell = self._status
        operations = [*self._operations.values()]
        if isinstance(last, OperationStatus) and last.id not in self._operations:
            operations.append(last)
        return {
            "cell": self._cell.name,
            "state": None if cell is None else cell.state,
            "reason": "" if cell is None else cell.reason,
            "operations": [_describe_operation(each) for each in operations],
        }

    async def _find_names(self, arms: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
        """Return the names of joints that the facts state, by the IRI of the arm; `arms` has those by short name."""
        try:
            rows = (await self._cell.query(JOINT_NAMES)).rows
        except SkillcError:
            return {}
        return {arms[str(arm)]: tuple(str(names).split()) for arm, names in rows if arm in arms}

    async def _follow(self, status: OperationStatus) -> None:
        """Publish the tree of an operation whenever it changes, until it ends."""
        operation = await self._server.operation(status.id)
        tree = StartedNodes(status.id, partial(self._topics.publish_text, "tree"))
        try:
            async with aclosing(operation.events()) as events:
                async for envelope in events:
                    tree.take(envelope.event)
            tree.show()
        finally:
            tree.close()


def _describe_operation(status: OperationStatus) -> dict[str, Any]:
    request = status.request
    return {
        "id": status.id,
        "what": request.task or request.goal or request.call or "",
        "state": status.state,
        "reason": status.reason,
        "allowed": status.allowed,
        "verified": status.verified,
        "failure": None if status.failure is None else status.failure.message,
    }


def _plain_joint(name: str) -> str:
    """Return the name of a joint of a cell's model as a name of ROS, such as `Ur5e_1_elbow`."""
    device, _, joint = name.rpartition("/")
    return f"{plain_name(device.rpartition(':')[2])}_{joint}" if device else joint


class CellTopics:
    """What a cell publishes, and what can be asked of it; `order` carries out an order, in the thread of a caller."""

    def __init__(self, node: Any, cell: str, order: Callable[[CellOrder | str], OrderAnswer]) -> None:
        self._node, self._order, self._count = node, order, 0
        self._below = f"/skillc/{plain_name(cell)}/"
        self._publishers: dict[str, Any] = {}
        from rclpy.callback_groups import ReentrantCallbackGroup
        from rclpy.qos import DurabilityPolicy, QoSProfile

        self._latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        group = ReentrantCallbackGroup()  # a pause that takes its time keeps nobody from a stop
        trigger = find_message("std_srvs/srv/Trigger")
        self._services = [
            node.create_service(trigger, self._below + word, self._answering(word), callback_group=group)
            for word in SERVICES
        ]
        self._text = find_message("std_msgs/msg/String")
        self._orders = node.create_subscription(self._text, self._below + "order", self._take, 10, callback_group=group)
        self._answers = node.create_publisher(self._text, self._below + "answer", 10)

    def show(self, sample: Sample, model: CellModel, names: Mapping[str, Sequence[str]]) -> None:
        """Publish what moves; `names` are those of the joints of each arm."""
        stamp = self._node.get_clock().now().to_msg()
        self._publish("joint_states", "sensor_msgs/msg/JointState", joint_state(sample, names, stamp))
        for individual, arm in sample.arms.items():
            if arm.wrench is not None:
                label = individual.rpartition("#")[2]
                topic, message = f"{plain_name(label)}/wrench", wrench(arm, f"{plain_name(label)}_base", stamp)
                self._publish(topic, "geometry_msgs/msg/WrenchStamped", message)
        if self._count % MARKERS_EVERY == 0:
            self._publish("markers", "visualization_msgs/msg/MarkerArray", markers(sample, model, stamp))
        self._count += 1

    def publish_text(self, topic: str, text: bytes) -> None:
        """Publish a JSON text, which late subscribers get as well."""
        self._publish(topic, "std_msgs/msg/String", self._text(data=text.decode()), latched=True)

    def _publish(self, topic: str, kind: str, message: Any, latched: bool = False) -> None:
        if topic not in self._publishers:
            quality = self._latched if latched else 10
            self._publishers[topic] = self._node.create_publisher(find_message(kind), self._below + topic, quality)
        self._publishers[topic].publish(message)

    def _answering(self, word: Word) -> Callable[[Any, Any], Any]:
        def answer(_: Any, response: Any) -> Any:
            found = self._order(CellOrder(word))
            response.success, response.message = found.success, found.message or found.operation
            return response

        return answer

    def _take(self, message: Any) -> None:
        self._answers.publish(self._text(data=msgspec.json.encode(self._order(message.data)).decode()))
