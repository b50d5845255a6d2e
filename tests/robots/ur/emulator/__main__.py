"""Run an emulated controller until the process is ended."""

from __future__ import annotations

import argparse
import asyncio
import gc
import os
import sys
from pathlib import Path
from threading import Thread
from time import monotonic

from robots.truth import serve_truth
from robots.ur.emulator.controller import Controller, Settings
from robots.ur.emulator.grippers import RobotiqPort, WsgPort
from robots.ur.emulator.panel import Panel
from robots.ur.emulator.plant import STEP_S, Plant
from robots.ur.emulator.rtde import RtdePort
from robots.ur.emulator.text_ports import Dashboard, ScriptPort
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc.world import load_scene, load_vocabulary
from skillc_rdf.vocabulary.types import Vocabulary

CATCH_UP_S = 0.1

FIRST_CYCLES = 50
"""Cycles before anybody is served: what is compiled is compiled, and sensors have settled."""


async def run(host: str, controller: Controller, patience_s: float) -> None:
    """Serve all ports, and let the cycles of the controller pass by the wall clock.

    While a client moves the arm, each cycle waits up to `patience_s` for its next command, which no real controller
    does: so that a busy machine is late for nothing. After a client was silent for that long, time passes again, so
    that the watchdog of its program expires.
    """
    rtde = RtdePort(controller.settings.version, controller.take)
    await rtde.serve(host)
    await Dashboard(controller).serve(host)
    await ScriptPort(controller).serve(host)
    await Panel(controller).serve(host)
    if controller.plant.hand is not None:
        await RobotiqPort(controller.plant).serve(host)
        await WsgPort(controller.plant).serve(host)
    for _ in range(FIRST_CYCLES):
        controller.cycle()
    print("ready", flush=True)
    due = monotonic()
    while True:
        controller.cycle()
        rtde.publish(controller.cycles, controller.outputs())
        due = max(due + STEP_S, monotonic() - CATCH_UP_S)
        await asyncio.sleep(max(due - monotonic(), 0.0))
        if patience_s > 0.0 and controller.is_commanded:
            await controller.wait_for_command(patience_s)
            due = monotonic()


def read_vocabulary(library: str | None) -> Vocabulary:
    """Return the terms of a shipped library; those that ship without library if it is None."""
    if library is None:
        return load_vocabulary()
    outcome = libraries.compile_library(find_library(SHIPPED / library))
    assert outcome.ok, outcome.diagnostics
    return outcome.value.vocabulary


def end_with_parent() -> None:
    """End this process when the one that has started it is gone."""
    sys.stdin.read()
    os._exit(0)


def main() -> None:
    """Read the options."""
    parser = argparse.ArgumentParser(prog="python -m robots.ur.emulator")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--host", default="127.0.36.1")
    parser.add_argument("--local", action="store_true", help="not in remote control")
    parser.add_argument("--version", default="5.23.0.100")
    parser.add_argument("--unlock", type=float, default=5.0, help="s before a protective stop can be released")
    parser.add_argument("--library", help="the shipped library whose terms the scene uses")
    parser.add_argument("--truth", type=Path, help="a socket, at which it is told what is true behind the controller")
    parser.add_argument("--patience", type=float, default=0.0, help="s for which a cycle waits for a command")
    parser.add_argument("--child", action="store_true", help="end when standard input ends")
    parser.add_argument("--button", type=int, default=-1, help="the digital input that the buttons of the scene switch")
    words = parser.parse_args()
    version = tuple(map(int, words.version.split(".")))
    settings = Settings(version=version, unlock_s=words.unlock, remote=not words.local, button=words.button)
    controller = Controller(Plant(load_scene(words.scene, read_vocabulary(words.library))), settings)
    if words.truth is not None:
        serve_truth(words.truth, controller.plant.capabilities.truth, lambda: controller.plant.now)
    if words.child:
        Thread(target=end_with_parent, daemon=True).start()
    gc.collect()
    gc.freeze()
    asyncio.run(run(words.host, controller, words.patience))


main()
