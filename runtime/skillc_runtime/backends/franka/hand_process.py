"""The process that talks to a Franka Hand: `python -m skillc_runtime.backends.franka.hand_process`.

A process of its own, because pylibfranka lets nothing else run in its process until fingers have come to rest. Lines of
JSON on standard input are carried out one after another: ["connect", ADDRESS], ["move", WIDTH, SPEED],
["grasp", WIDTH, SPEED, FORCE], ["stop"], ["home"]; in m, m/s and N. Each is answered with a line of JSON, and while
nothing is to be done the hand is read every `SENSING_S`: {"done": how many lines were carried out, "opening": m,
"max": m, "grasped": bool} or {"done": .., "error": TEXT}.
"""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from importlib import import_module
from queue import Empty, Queue
from threading import Thread
from typing import Any, Final

SENSING_S: Final = 0.02
ANY_WIDTH_M: Final = 1.0
"""Whatever is between the fingers counts as grasped; how wide it is, is measured."""


def main() -> None:
    """Carry out lines until there are no more."""
    library, hand = import_module("pylibfranka"), None
    done, arrived = 0, Queue[bytes]()
    print(json.dumps({"done": done}), flush=True)
    Thread(target=_pass_on, args=(arrived,), daemon=True).start()
    while True:
        lines = _take(arrived, None if hand is None else SENSING_S)
        if b"" in lines:
            return
        try:
            for line in lines:
                done += 1
                hand = carry_out(library, hand, *json.loads(line))
            said = read(hand)
        except (RuntimeError, library.FrankaException) as error:
            print(json.dumps({"done": done, "error": str(error).removeprefix("libfranka: ")}), flush=True)
            if isinstance(error, library.NetworkException):
                return
        else:
            print(json.dumps({"done": done, **said}), flush=True)


def _pass_on(arrived: Queue[bytes]) -> None:
    """Put the lines of standard input into a queue, and an empty one at its end."""
    for line in sys.stdin.buffer:
        arrived.put_nowait(line)
    arrived.put_nowait(b"")


def _take(arrived: Queue[bytes], seconds: float | None) -> list[bytes]:
    """Return the lines that have arrived; wait for one for so long, or, without a limit, until there is one."""
    lines = []
    with suppress(Empty):
        lines.append(arrived.get(timeout=seconds))  # The last line is empty, so there always is one.
        while True:
            lines.append(arrived.get_nowait())
    return lines


def carry_out(library: Any, hand: Any, order: str, *arguments: Any) -> Any:
    """Carry out an order; return the hand, which is connected from the first one on."""
    match order:
        case "connect":
            return library.Gripper(*arguments)
        case "move":
            hand.move(*arguments)
        case "grasp":
            width, speed, force = arguments
            hand.grasp(width, speed, force, ANY_WIDTH_M, ANY_WIDTH_M)
        case "stop":
            hand.stop()
        case "home":
            hand.homing()
    return hand


def read(hand: Any) -> dict[str, Any]:
    """Return what the hand measures."""
    state = hand.read_once()
    return {"opening": state.width, "max": state.max_width, "grasped": state.is_grasped}


if __name__ == "__main__":
    main()
