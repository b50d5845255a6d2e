"""Runs franky-sim, a simulated robot that speaks the Franka Control Interface, with things around it.

    python -m robots.franka.peer ADDRESS FRICTION [SCENE [HEIGHT TRUTH]]

FRICTION is the share of its friction in the joints that is left while torques are commanded: a real robot closes a
loop around the torque behind each gear, so that little of the gear's friction is felt; the simulated one applies what
is commanded before the gear. Its own position controller would not be stable with less friction.
SCENE is a MuJoCo model whose bodies and geoms are added. What is true of them is told at the socket TRUTH, in a world
in which the robot's base is HEIGHT m above 0. "ready" is printed when the robot answers. Lines on standard
input are answered with one line of JSON: `pose BODY` (position in m), `force GEOM` (N that press on it), `travel JOINT`
(m), `carry KG` (from now on, so much more in the hand, which nobody knows of), `wall GAP` (puts one GAP m before the
tool, and returns its normal), `wall-force` (in N), `no-wall`, `wipe GEOM BODY` (from now on, a body wipes the top of a
box), `wiped` (the share of the top that was).
"""

from __future__ import annotations

import json
import sys
import threading
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from franky_sim import SimulationServer
from franky_sim.franka_robot_server import ControlMode
from franky_sim.mujoco_simulator import MujocoSimulator

from robots.franka.truth import PeersTruth
from robots.franka.wall import Wall
from robots.priority import run_promptly
from robots.truth import serve_truth

KP, KV = (4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 500.0), (450.0, 450.0, 350.0, 350.0, 200.0, 200.0, 50.0)
"""Gains of its own position controller: with those for the last joint that are usual there, it never comes to rest."""

CELL_M = 0.005
FACE_M = np.array([0.05, 0.025])
"""Half of the face that wipes."""
LEAST_N = 1.0
EVERY = 10


class Wiping:
    """Which share of the top of a box a body has wiped."""

    def __init__(self, model: Any, geom: str, body: str) -> None:
        box = model.geom(geom)
        self.geom, self._body = box.id, model.body(body).id
        counts = np.round(2 * box.size[:2] / CELL_M).astype(int)
        grid = np.stack(np.meshgrid(*((np.arange(n) + 0.5) * CELL_M - n * CELL_M / 2 for n in counts)), axis=-1)
        self._cells = box.pos[:2] + grid.reshape(-1, 2)
        self._wiped, self._steps = np.zeros(len(self._cells), dtype=bool), 0

    def see(self, data: Any, force: float) -> None:
        """Note a step with a force in N on the box."""
        self._steps += 1
        if force > LEAST_N and self._steps % EVERY == 0:
            axes = data.xmat[self._body].reshape(3, 3)
            there = (self._cells - data.xpos[self._body][:2]) @ axes[:2, :2]
            self._wiped |= (np.abs(there) <= FACE_M).all(axis=1)

    @property
    def share(self) -> float:
        return float(self._wiped.mean())


class Observer:
    """Answers questions about the simulation, between two of its steps."""

    def __init__(self, simulator: MujocoSimulator) -> None:
        self._simulator, self._turn = simulator, threading.Lock()
        self._wiping: Wiping | None = None
        self.truth: PeersTruth | None = None
        self._wall: Wall | None = None
        simulator.register_pre_step_callback(self._before_step)
        simulator.register_post_step_callback(self._after_step)

    def answer(self, question: str, *names: str) -> object:
        model, data = self._simulator.model, self._simulator.data
        with self._turn:
            match question:
                case "pose":
                    return list(data.body(*names).xpos)
                case "force":
                    return self.force_on(model.geom(*names).id)
                case "travel":
                    return float(data.joint(*names).qpos[0])
                case "carry":
                    hand = next(each for each in range(model.nbody) if model.body(each).name.endswith("hand"))
                    model.body_mass[hand] += float(names[0])
                case "wall":
                    self._wall = Wall(model, data, float(names[0]))
                    return self._wall.normal.tolist()
                case "wall-force":
                    return 0.0 if self._wall is None else self._wall.force_n
                case "no-wall" if self._wall is not None:
                    self._wall.remove()
                    self._wall = None
                case "wipe":
                    self._wiping = Wiping(model, *names)
                case "wiped":
                    assert self._wiping is not None
                    return self._wiping.share
            return None

    def _before_step(self, _: MujocoSimulator) -> None:
        self._turn.acquire()
        if self._wall is not None:
            self._wall.step()

    def _after_step(self, _: MujocoSimulator) -> None:
        if self._wiping is not None:
            self._wiping.see(self._simulator.data, self.force_on(self._wiping.geom))
        if self.truth is not None:
            self.truth.see()
        self._turn.release()

    def force_on(self, geom: int) -> float:
        """Return the sum of the normal forces in N on a geom."""
        model, data = self._simulator.model, self._simulator.data
        found, total = np.zeros(6), 0.0
        for index in np.flatnonzero((data.contact.geom == geom).any(axis=1)):
            mujoco.mj_contactForce(model, data, index, found)
            total += found[0]
        return float(total)


def ease_joints(simulator: MujocoSimulator, share: float) -> None:
    """Leave a share of the friction in the joints while torques are commanded."""
    own = simulator.model.dof_frictionloss.copy()
    server = simulator.robots[0].server

    def set_friction(_: MujocoSimulator) -> None:
        is_eased = server._FrankaRobotServer__control_mode is ControlMode.TORQUE
        simulator.model.dof_frictionloss[:] = share * own if is_eased else own

    simulator.register_pre_step_callback(set_friction)


def main(
    address: str, friction: str, scene: str | None = None, height: str | None = None, truth: str | None = None
) -> None:
    run_promptly()
    with MujocoSimulator() as simulator:
        simulator.add_robot(kp=KP, kv=KV)
        if scene is not None:
            for element in ET.fromstring(Path(scene).read_text("utf-8")).iterfind("worldbody/*"):
                simulator.worldbody.append(element)
        observer = Observer(simulator)
        with SimulationServer(simulator, hostname_candidates=[address]) as server:
            ease_joints(simulator, float(friction))
            server.run_async()
            if height is not None and truth is not None:
                model, data = simulator.model, simulator.data
                observer.truth = PeersTruth(model, data, observer.force_on, float(height))
                serve_truth(Path(truth), observer.truth, lambda: float(data.time))
            print("ready", flush=True)
            for line in sys.stdin:
                print(json.dumps(observer.answer(*line.split())), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
