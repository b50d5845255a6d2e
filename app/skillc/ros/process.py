"""The process of the node: `python -m skillc.ros.process`, with SKILLC_SERVER and SKILLC_TOKEN in its environment.

It ends with the server, which has started it, or with its standard input.
"""

from __future__ import annotations

import asyncio
import sys
import threading
from collections.abc import Callable
from contextlib import aclosing, suppress
from functools import partial
from typing import Any

from skillc.client.connecting import connect_async
from skillc.client.errors import UnavailableError
from skillc.contract.cell import CellStatus
from skillc.errors import SkillcError
from skillc.ros.cell_bridge import CellBridge
from skillc_runtime.backends.ros2.session import Session
from skillc_runtime.devices.backend import BackendUnavailable

THREADS = 4
"""How many orders are answered at the same time."""
RETRY_S = 1.0
"""How long after its end the motion of a cell is asked for again, in s."""


async def run(node: Any) -> None:
    """Publish the cells of the server, and pass on orders, until the server or standard input ends."""
    loop, task = asyncio.get_running_loop(), asyncio.current_task()
    assert task is not None
    end = partial(loop.call_soon_threadsafe, task.cancel)
    threading.Thread(target=_end_with_input, args=(end,), daemon=True).start()
    async with connect_async() as server:
        bridges = {each.name: CellBridge(node, server, await server.cell(each.name)) for each in await server.cells()}
        motions = [asyncio.create_task(_keep_showing(each)) for each in bridges.values()]
        try:
            async with aclosing(server.watch()) as changes:
                async for status in changes:
                    name = status.name if isinstance(status, CellStatus) else status.cell
                    if name in bridges:
                        bridges[name].take(status)
        finally:
            for bridge in bridges.values():
                bridge.close()
            for motion in motions:
                motion.cancel()


async def _keep_showing(bridge: CellBridge) -> None:
    """Show what moves, again after the cell was off; ends, and says why, if ROS 2 lacks a type of message."""
    while True:  # wait ends: with the node, which cancels it
        try:
            with suppress(SkillcError):
                await bridge.show_motion()
        except BackendUnavailable as error:
            print(error, file=sys.stderr)
            return
        await asyncio.sleep(RETRY_S)


def main() -> int:
    """Run the node; return the exit code."""
    try:
        session = Session("skillc")
    except BackendUnavailable as error:
        print(error, file=sys.stderr)
        return 1
    from rclpy.executors import MultiThreadedExecutor

    executor = MultiThreadedExecutor(THREADS, context=session.node.context)
    executor.add_node(session.node)
    threading.Thread(target=executor.spin, daemon=True).start()
    try:
        with suppress(UnavailableError, KeyboardInterrupt, asyncio.CancelledError):
            asyncio.run(run(session.node))
    except SkillcError as error:
        print(error, file=sys.stderr)
        return 1
    finally:
        executor.shutdown(1.0)
        session.close()
    return 0


def _end_with_input(end: Callable[[], object]) -> None:
    """Call `end` when the process that has started this one is gone."""
    sys.stdin.buffer.read()  # wait ends: with the process at its other end
    with suppress(RuntimeError):  # The loop has ended before.
        end()


if __name__ == "__main__":
    sys.exit(main())
