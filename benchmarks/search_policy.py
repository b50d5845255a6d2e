"""What an environment of `skillc.gym` costs, and what a small policy search learns in it.

`search_policy.py [GENERATIONS [POPULATION [WORLDS]]]`: steps a second beside bare `mj_step` of the same time; then the
cross-entropy method searches eight numbers of a policy that turns about the start and moves outwards. Both it and the
spiral that the skill has are tried in fresh worlds.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from statistics import median
from time import process_time

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc.gym import LIMIT_S, PERIOD_S, SearchEnv
from skillc_runtime.backends.mujoco.cell import SimulatedCell

FRESH = range(100_000, 100_040)
STEPS = 400
Array = NDArray[np.float32]
Policy = Callable[[Array], Array]


def spiral(seen: Array) -> Array:
    """Return what the spiral of the skill does: turns of .4 mm in a search of 9 mm, at its speed."""
    outwards, around, radius = find_directions(seen)
    turn = 0.4 / 9.0 / (2.0 * np.pi)
    return (outwards * turn / max(radius, turn) + around).astype(np.float32)


def find_directions(seen: Array) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Return the directions outwards and around (2,), and how far out the search is, in its radii."""
    radius = float(np.hypot(*seen[:2]))
    outwards = seen[:2] / radius if radius > 1e-3 else np.array([1.0, 0.0])
    return outwards, np.array([-outwards[1], outwards[0]]), radius


def steer(weights: NDArray[np.float64], seen: Array) -> Array:
    """Return the action of the policy with weights (2, 4)."""
    outwards, around, radius = find_directions(seen)
    shares = np.tanh(weights @ [1.0, 0.02 / max(radius, 0.02), radius, seen[7]])
    return (shares @ [outwards, around]).astype(np.float32)


def run(env: SearchEnv, policy: Policy, seed: int) -> float | None:
    """Return how long, in s of the cell, a search takes; None if it finds nothing."""
    seen, _ = env.reset(seed=seed)
    while True:
        seen, _, terminated, truncated, info = env.step(policy(seen))
        if terminated or truncated:
            return info["sim_time_s"] if info.get("outcome") == "found" else None


def time_steps(env: SearchEnv) -> None:
    """Print what steps cost beside bare physics of the same model in the same time."""
    env.reset(seed=0)
    began, done = process_time(), 0
    for _ in range(STEPS):
        _, _, terminated, truncated, _ = env.step(env.action_space.sample())
        done += 1
        if terminated or truncated:
            break
    took_s = (process_time() - began) / done
    cell = env._episodes.cell
    assert isinstance(cell, SimulatedCell)
    model, data = cell.model, cell.data
    bare = round(PERIOD_S / model.opt.timestep)
    began = process_time()
    for _ in range(bare * 20):
        mujoco.mj_step(model, data)
    bare_s = (process_time() - began) / 20
    print(f"{1.0 / took_s:.0f} steps of {PERIOD_S:g} s a second, {took_s / bare_s:.2f} times bare mj_step")


def search(env: SearchEnv, generations: int, population: int, worlds: int) -> NDArray[np.float64]:
    """Return the weights that the cross-entropy method ends with; print each generation."""
    chance = np.random.default_rng(0)
    mean, spread = np.zeros((2, 4)), np.ones((2, 4))
    for generation in range(generations):
        tried = mean + spread * chance.standard_normal((population, 2, 4))
        seeds = range(generation * worlds, (generation + 1) * worlds)
        times = [[run(env, lambda seen, w=each: steer(w, seen), seed) or LIMIT_S for seed in seeds] for each in tried]
        means = np.mean(times, axis=1)
        best = tried[np.argsort(means)[: max(2, population // 4)]]
        mean, spread = best.mean(axis=0), best.std(axis=0) + 0.1 * 0.85**generation
        print(f"generation {generation}: {means.mean():.1f} s in the mean, {means.min():.1f} s the best", flush=True)
    return mean


def main(generations: int = 10, population: int = 16, worlds: int = 6) -> None:
    """Time steps, search, and compare with the spiral in fresh worlds."""
    env = SearchEnv("contact:insert_peg")
    time_steps(env)
    weights = search(env, generations, population, worlds)
    for name, policy in (("the spiral", spiral), ("the policy", lambda seen: steer(weights, seen))):
        times = [run(env, policy, seed) for seed in FRESH]
        found = [each for each in times if each is not None]
        mean = np.mean([LIMIT_S if each is None else each for each in times])
        print(f"{name}: {len(found)} of {len(times)} found, median {median(found):.2f} s, mean {mean:.2f} s")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
