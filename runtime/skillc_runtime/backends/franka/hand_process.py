"""The process that talks to a Franka Hand: `python -m skillc_runtime.backends.franka.hand_process`.

A process of its own, because pylibfranka lets nothing else run in its process until fingers have come to rest. Lines of
JSON on standard input are carried out one after another: ["connect", ADDRESS], ["move", WIDTH, SPEED],
["grasp", WIDTH, SPEED, FORCE], ["stop"], ["home"]; in m, m/s and N. Each is answered with a line of JSON, and while
nothing is to be done the hand is read every `SENSING_S`: {"done": how many lines were carried out, "opening": m,
"max": m, "grasped": bool} or {"done": .., "error": TEXT}.
"""

from __future__ import annotations

import json
import os
import select
from importlib import import_module
from typing import Any, Final

SENSING_S: Final = 0.02
ANY_WIDTH_M: Final = 1.0
"""Whatever is between the fingers counts as grasped; how wide it is, is measured."""


def main() -> None:
    """Carry out lines until there are no more."""
    library, hand = import_module("pylibfranka"), None
    done, waiting = 0, b""
    print(json.dumps({"done": done}), flush=True)
    while True:
        ready, _, _ = select.select([0], [], [], None if hand is None else SENSING_S)
        if ready:
            if not (data := os.read(0, 1 << 12)):
                return
            waiting += data
        *lines, waiting = waiting.split(b"\n")
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
