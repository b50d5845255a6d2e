"""Prints what the laws and everything under them compute for drawn inputs, to compare their two forms."""

from __future__ import annotations

import json
import sys

import numpy as np
from msgspec.structs import replace
from rig import GAINS, LAWS, ROBOTS, Bench, moved_by

from skillc_runtime.backends.mujoco.wrist import WristFilter, filter_wrist
from skillc_runtime.backends.simulation.arms.geometry_errors import GeometryErrors
from skillc_runtime.backends.simulation.arms.motor_memory import MotorMemory, pursue
from skillc_runtime.backends.simulation.arms.sensing import ArmSensing, LastLink, MassMemory, measure, take_mass
from skillc_runtime.control.laws.controllers import make_controllers
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.control.limits import EXPECTED, SpeedLimit
from skillc_runtime.control.momentum_observer import MomentumObserver
from skillc_runtime.control.period import ArmMemory, copy_state, make_state, watch_arm
from skillc_runtime.control.supervision.command_validator import update_holding
from skillc_runtime.control.supervision.safety import SafetyLimits, SafetyMonitor, distance_outside, tool_speed
from skillc_runtime.control.supervision.signal_memory import find_speeds
from skillc_runtime.devices.arm import Capabilities, command_values
from skillc_runtime.motion.coverage import add_dose
from skillc_runtime.motion.overlays import Circle, Lissajous
from skillc_runtime.motion.paths.arc import arc_through
from skillc_runtime.motion.paths.path import join_segments, path_through
from skillc_runtime.motion.paths.segments import MotionLimits, segment_between
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.motion.reference import Compliance, Reference
from skillc_runtime.motion.reference_generator import ReferenceGenerator


def laws(robot: str, count: int) -> list[list[float]]:
    """What one law commands for drawn postures, references and compliances, one after the other."""
    chance, bench, told = np.random.default_rng(5), Bench(robot), []
    home = bench.data.qpos.copy()
    model = load_virtual_model(ROBOTS / f"{robot}.xml")
    for step in range(count):
        if step % 20 == 0:
            state = bench.state()
            law = make_controllers(GAINS[robot], bench.limits, model, state, 0.001)
            law.tool.reset(state, state.q, np.zeros_like(state.q))
        bench.data.qpos[:] = home + chance.uniform(-0.05, 0.05, home.size)
        bench.data.qvel[:] = chance.uniform(-0.3, 0.3, home.size)
        state = replace(bench.state_at_rest(), wrench=chance.uniform(-20, 20, 6))
        twist, acceleration = chance.uniform(-0.5, 0.5, (2, 6))
        pose = moved_by(state.tool, *chance.uniform(-0.06, 0.06, 3), turn=chance.uniform(-0.3, 0.3, 3))
        released = chance.choice([0.0, 0.01, 1.0], 6)
        stiffness = released * np.repeat([GAINS[robot].linear_stiffness, GAINS[robot].rotational_stiffness], 3)
        compliance = Compliance(stiffness, chance.uniform(-20, 20, 6), exp(chance.uniform(-3, 3, 3)))
        command = law.tool.command(state, Reference.of(pose, twist, acceleration), compliance, 0.001)
        told.append([*(command.tau if LAWS[robot] == "impedance" else command.q), *law.tool.contact_wrench])
    return told


def speeds(count: int) -> list[list[float]]:
    """What joints are told that take speeds, and where they are expected to be."""
    chance, bench = np.random.default_rng(11), Bench("ur5e")
    state, told = bench.state(), []
    limit = SpeedLimit(bench.limits, state.q, 5.0, 0.015)
    for _ in range(count):
        measured = replace(state, q=limit.q + chance.uniform(-0.05, 0.05, bench.nv))
        command = limit.step(limit.q + chance.uniform(-0.01, 0.01, bench.nv), measured, 0.002)
        told.append([*command_values(command), *limit.rows[EXPECTED]])
    return told


def servos(count: int) -> list[list[float]]:
    """Where the targets of servos go that are told speeds; in between all stand still."""
    chance, targets, told = np.random.default_rng(12), np.zeros(6), []
    for step in range(count):
        speed, q, dq, lead, farthest = chance.uniform(-1.0, 1.0, (5, 6)) * [[step % 3 > 0], [0.02], [1], [0.01], [0.01]]
        own, leads = np.zeros((3, 6)), (np.abs(lead), np.abs(farthest))
        pursue(MotorMemory(own[0, :2], np.inf, targets, own[1], own[2], q, dq, speed, *leads, 0.001), 0.0)
        told.append(targets.tolist())
    return told


def references(count: int) -> list[list[float]]:
    """Where a guide's reference is on a blended, turning path, with an overlay that comes and goes."""
    start = Bench("iiwa14").state().tool
    corners = (moved_by(start, 0.2, 0, 0, turn=(0, 0.5, 0)), moved_by(start, 0.2, 0.1, 0, turn=(0.4, 0.5, 0.0)))
    guide = ReferenceGenerator(start, 0.5)
    guide.follow(path_through([start, *corners, start], MotionLimits(0.1, 0.4), 0.01), 0.0)
    handle, found = guide.add(Circle(0.01, 1.0), exp(np.array([0.1, 0.2, 0.3])), 0.5, 0.1), []
    for step in range(count):
        now = 0.1 + 8.0 * step / count
        if step == count // 2:
            guide.remove(handle, now)
            guide.pause(now)
        motion = guide.sample(now)
        found.append([*motion.pose.position, *motion.pose.rotation.ravel(), *motion.twist, *motion.acceleration])
    return found


def curves(count: int) -> list[list[float]]:
    """Where a path of a line, an arc and a turn leads that are blended and limited in jerk."""
    start, limits = Bench("iiwa14").state().tool, MotionLimits(0.1, 0.4, jerk=3.0, turn_jerk=9.0)
    side, over = moved_by(start, 0.1, 0, 0), moved_by(start, 0.2, 0.1, 0, turn=(0.0, 0.3, 0.1))
    arc = arc_through(side, moved_by(start, 0.17, 0.03, 0).position, over, limits)
    end = moved_by(start, 0.2, 0.1, 0, turn=(0.4, 0.3, 0.1))
    pieces = segment_between(start, side, limits), arc, segment_between(over, end, limits)
    motion = join_segments((start, side, over, end), pieces, limits, 0.01)
    samples = [motion.at(motion.duration * step / (count - 1)) for step in range(count)]
    return [[*s.pose.position, *s.pose.rotation.ravel(), *s.twist, *s.acceleration] for s in samples]


def watched(count: int) -> list[list[float]]:
    """What is made of the states of an arm in view of its limits."""
    chance, bench, found = np.random.default_rng(7), Bench("iiwa14"), []
    felt, box = MomentumObserver(bench.state()), exp(np.array([0.3, -0.2, 0.9]))
    for _ in range(count):
        bench.data.qvel[:] = chance.uniform(-0.3, 0.3, 7)
        state = bench.state_at_rest()
        felt.add_command(chance.uniform(-20, 20, 7), state.bias, 0.002)
        felt.step(state, 0.002)
        middle, size = chance.uniform(-1, 1, (2, 3))
        outside = distance_outside(state.tool.position, middle, box, np.abs(size))
        found.append([*felt.wrench(state), *felt.unexplained(state), tool_speed(state.jacobian, state.dq), outside])
    return found


def signals(count: int) -> list[list[float]]:
    """What is kept of the signals of an arm with a wrist, most of them plausible, and the speeds at a stop."""
    chance, bench, found = np.random.default_rng(13), Bench("ur5e"), []
    able = Capabilities(("position",), True, True, bench.limits, never_repeats=True)
    safety = SafetyMonitor(SafetyLimits(80.0, 5.0), bench.state(), "position", able)
    state, nv = make_state(bench.nv), bench.nv
    copy_state(bench.state_at_rest(), state)
    arm = ArmMemory(state, np.zeros(nv), 0.0, np.zeros(3), safety.memory, np.zeros(4), 0.002)
    for step in range(count):
        before = state.dq.copy()
        state.dq[:] += chance.uniform(-0.05, 0.05, nv)
        state.q[:] += 0.001 * (before + state.dq) + chance.choice([0.0, 1e-2], nv, p=[0.98, 0.02])
        state.wrench[:], state.effort[:] = chance.uniform(-9, 9, 6), state.bias + chance.uniform(-5, 5, nv)
        bits, dq = watch_arm(arm, 0.0), np.zeros(nv)
        find_speeds(dq, safety.memory.signals, state.mass_matrix.copy())
        kept = safety.memory.signals
        found.append([float(bits), *dq, *kept.joints.ravel(), *kept.numbers, *kept.wrench, *kept.history.ravel()])
        if step % 10 == 9:
            safety.forget_signals()
    return found


def measurements(count: int) -> list[list[float]]:
    """What an arm makes of link, base, payload and wrist readings."""
    chance, hand, found = np.random.default_rng(6), LastLink(), []
    for _ in range(count):
        hand.on_link[:] = chance.uniform(-1, 1, (8, 3))
        J, joints, wrench, readings = np.zeros((6, 7)), np.zeros((7, 7)), np.zeros(6), chance.uniform(-20, 20, 9)
        link, base = exp(chance.uniform(-3, 3, 3)), exp(chance.uniform(-3, 3, 3))
        axes, (centre, position, origin, weight) = chance.uniform(-1, 1, (7, 6)), chance.uniform(-1, 1, (4, 3))
        raw, noise, mean = chance.uniform(-20, 20, (3, 9))
        grain = chance.uniform(-0.1, 0.2, 9)
        wrist = WristFilter(
            readings, readings.copy(), mean, raw, noise[None], np.zeros(1), 0.3, 0.01, np.ones(1), grain, 0.002,
            np.zeros(1),
        )  # fmt: skip
        filter_wrist(wrist, 0.0)
        q, dq, bias, noise = chance.uniform(-1, 1, (4, 7))
        velocity = np.zeros(3)
        sensing = ArmSensing(
            joints, hand.in_base, hand.rotation, J, wrench, velocity, q, dq, bias, chance.uniform(0.9, 1.1),
            *chance.uniform(-1, 1, (2, 7)),
            hand.on_link, axes, centre, Pose(position, link), Pose(origin, base), weight,
            *chance.uniform(-9, 9, (4, 7)), chance.uniform(-1, 1, (6, 9)), readings, chance.uniform(-1, 1, (2, 6)),
            noise[None], np.zeros(1), np.array([0.0, 0.0, -0.7]),
            GeometryErrors(
                chance.uniform(-1e-3, 1e-3, (2, 6)), np.array([[1, 0], [2, 1]]), chance.uniform(-1e-3, 1e-3, 7),
                chance.uniform(-1, 1, (3, 3)), chance.uniform(-1, 1, (3, 9)), 1.0, np.zeros((5, 3)),
            ),
        )  # fmt: skip
        measure(sensing, 0.0)
        dose, tool, (place, origin) = np.zeros((20, 30)), np.array([0.1, 0.05]), chance.uniform(-0.1, 0.1, (2, 3))
        x, y, world = np.linspace(-0.2, 0.2, 30), np.linspace(-0.1, 0.1, 20), Pose(origin, base)
        add_dose(dose, x, y, world, place, link, tool, 0.01)
        mass, sines = np.eye(7), Lissajous(*chance.uniform(-1, 1, (3, 3))).at(chance.uniform(0, 5))
        whole, unused = np.eye(9) + 0.1, np.zeros((1, 4), dtype=np.int64)
        take_mass(MassMemory(mass, whole, 2.0, unused, np.array([0.3]), np.zeros(3), hand.lever, J), 0.0)
        kept = np.zeros(7)
        numbers = [update_holding(kept, *joints[:3], also, position) for also in (wrench, wrench * np.nan)]
        seen = (hand.in_base, J, joints, wrench, velocity, mass, dose, sines, kept)
        found.append([*np.concatenate([each.ravel() for each in seen]), *map(float, numbers)])
    return found


def everything(count: int) -> dict[str, list[list[float]]]:
    """All of it, a row for each input."""
    results = {robot: laws(robot, count) for robot in LAWS}
    others = {
        part.__name__: part(count) for part in (references, curves, watched, measurements, speeds, servos, signals)
    }
    return {**results, **others}


if __name__ == "__main__":
    json.dump(everything(int(sys.argv[1])), sys.stdout)
