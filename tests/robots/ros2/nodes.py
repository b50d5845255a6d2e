"""Nodes of ROS 2 in a test, which answer what they are asked."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Thread
from time import monotonic, sleep
from typing import Any

from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.backends.ros2.session import Session, find_message
from waiting import LONG_S


@contextmanager
def spun(session: Session, *more: Any) -> Iterator[None]:
    """Let nodes of a session answer in a thread."""
    from rclpy.executors import SingleThreadedExecutor

    executor = SingleThreadedExecutor(context=session.context)
    for node in (session.node, *more):
        executor.add_node(node)
    thread = Thread(target=executor.spin, daemon=True)
    thread.start()
    try:
        yield
    finally:
        executor.shutdown(1.0)
        thread.join(LONG_S)


def offer(session: Session, service: str, act: Callable[[], str]) -> None:
    """Offer a service that refuses if `act` returns why."""

    def answer(_: Any, response: Any) -> Any:
        response.message = act()
        response.success = not response.message
        return response

    session.node.create_service(find_message("std_srvs/srv/Trigger"), service, answer)


@contextmanager
def receiving(make: Callable[[Receiver], Any]) -> Iterator[Any]:
    receiver = Receiver("devices")
    try:
        made = make(receiver)
        receiver.begin()
        yield made
    finally:
        receiver.close()


def wait_until(holds: Callable[[], Any], then: Callable[[], None] = lambda: None, seconds: float = LONG_S) -> Any:
    """Do something again and again until something holds; return that."""
    end = monotonic() + seconds
    while not (found := holds()):
        assert monotonic() < end
        then()
        sleep(0.05)
    return found
