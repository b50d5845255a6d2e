"""Runs franky-sim, a simulated robot that speaks the Franka Control Interface, with things around it.

    python -m robots.franka.peer ADDRESS FRICTION [SCENE]

FRICTION is the share of its friction in the joints that is left: a real robot closes a loop around the torque behind
each gear, so that little of the gear's friction is felt; the simulated one applies what is commanded before the gear.
SCENE is a MuJoCo model whose bodies and geoms are added. "ready" is printed when the robot answers. Lines on standard
input are answered with one line of JSON: `pose BODY` (position in m), `force GEOM` (N that press on it), `log GEOM`
(from now on, samples of a geom's normal force and of the hand), `save FILE` (writes them, (n, 8): time s, force N,
position of the hand (3,) m, axis of the hand (3,)).
"""

from __future__ import annotations

import json
import sys
import threading
import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
from franky_sim import SimulationServer
from franky_sim.mujoco_simulator import MujocoSimulator

from robots.franka.priority import run_promptly

HAND = "robot0_hand"


class Observer:
    """Answers questions about the simulation, between two of its steps."""

    def __init__(self, simulator: MujocoSimulator) -> None:
        self._simulator, self._turn = simulator, threading.Lock()
        self._logged: int | None = None
        self._samples: list[np.ndarray] = []
        simulator.register_pre_step_callback(lambda _: self._turn.acquire())
        simulator.register_post_step_callback(self._after_step)

    def answer(self, question: str, name: str) -> object:
        model, data = self._simulator.model, self._simulator.data
        with self._turn:
            match question:
                case "pose":
                    return list(data.body(name).xpos)
                case "force":
                    return self._force(model.geom(name).id)
                case "log":
                    self._logged, self._samples = model.geom(name).id, []
                case "save":
                    np.save(name, np.array(self._samples))
            return None

    def _after_step(self, _: MujocoSimulator) -> None:
        if self._logged is not None:
            hand = self._simulator.data.body(HAND)
            axis = hand.xmat.reshape(3, 3)[:, 2]
            self._samples.append(
                np.array([self._simulator.data.time, self._force(self._logged), *hand.xpos.copy(), *axis])
            )
        self._turn.release()

    def _force(self, geom: int) -> float:
        model, data = self._simulator.model, self._simulator.data
        found, total = np.zeros(6), 0.0
        for index in np.flatnonzero((data.contact.geom == geom).any(axis=1)):
            mujoco.mj_contactForce(model, data, index, found)
            total += found[0]
        return float(total)


def main(address: str, friction: str, scene: str | None = None) -> None:
    run_promptly()
    with MujocoSimulator() as simulator:
        simulator.add_robot()
        if scene is not None:
            for element in ET.fromstring(Path(scene).read_text("utf-8")).iterfind("worldbody/*"):
                simulator.worldbody.append(element)
        observer = Observer(simulator)
        with SimulationServer(simulator, hostname_candidates=[address]) as server:
            simulator.model.dof_frictionloss[:] *= float(friction)
            server.run_async()
            print("ready", flush=True)
            for line in sys.stdin:
                question, _, name = line.strip().partition(" ")
                print(json.dumps(observer.answer(question, name)), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
