"""A search that is steered: its motion is smooth and stays near its circle, and environments are those of Gymnasium."""

from __future__ import annotations

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from hypothesis import strategies as st

import skillc
from skillc.gym import SearchEnv
from skillc_runtime.primitives.steering import SteeredOverlay

RADIUS_M, PERIOD_S, STEP_S = 0.01, 0.05, 1e-5
shares = st.tuples(*2 * [st.floats(-1.0, 1.0)]).map(lambda each: 0.02 * np.array(each))


@given(st.lists(shares, min_size=1, max_size=30))
def test_a_steered_motion_is_smooth_and_stays_near_its_circle(velocities: list[np.ndarray]) -> None:
    overlay = SteeredOverlay(RADIUS_M)
    for number, velocity in enumerate(velocities):
        time = number * PERIOD_S
        before = overlay.at(time)
        overlay.steer(time, velocity)
        after = overlay.at(time)
        assert np.allclose(before[:2], after[:2], atol=1e-12), "no jump of place and velocity"
        for t in (time + 0.2 * PERIOD_S, time + 0.9 * PERIOD_S):
            low, here, high = (overlay.at(t + s) for s in (-STEP_S, 0.0, STEP_S))
            assert np.allclose((high[:2] - low[:2]) / (2 * STEP_S), here[1:], atol=1e-5)
            assert np.linalg.norm(here[0]) < RADIUS_M + 0.005 and here[0, 2] == 0.0


def spiral(seen: np.ndarray) -> np.ndarray:
    """Return the action of a spiral with turns of .4 mm in a search of 9 mm."""
    radius, turn = float(np.hypot(*seen[:2])), 0.4 / 9.0 / (2.0 * np.pi)
    outwards = seen[:2] / radius if radius > 1e-3 else np.array([1.0, 0.0])
    action = outwards * turn / max(radius, turn) + np.array([-outwards[1], outwards[0]])
    return action.astype(np.float32)


@pytest.mark.sim
def test_it_is_an_environment_of_gymnasium() -> None:
    check_env(SearchEnv(limit_s=1.0), skip_render_check=True)


@pytest.mark.sim
@pytest.mark.parametrize("task", ["contact:insert_peg", "contact:insert_peg_iiwa"])
def test_who_turns_outwards_finds_the_hole_and_who_stands_still_does_not(task: str) -> None:
    env = SearchEnv(task)
    seen, info = env.reset(seed=7)
    start = info["world"]
    rewards = []
    for _ in range(400):
        seen, reward, terminated, truncated, info = env.step(spiral(seen))
        rewards.append(reward)
        if terminated or truncated:
            break
    assert (terminated, truncated, info["outcome"]) == (True, False, "found")
    assert sum(rewards) == pytest.approx(20.0 - info["sim_time_s"])
    with pytest.raises(skillc.RequestError, match="call reset"):
        env.step(spiral(seen))
    assert env.reset(seed=7)[1]["world"] == start
    for _ in range(40):
        seen, reward, terminated, truncated, info = env.step(np.zeros(2, np.float32))
    assert not terminated and "outcome" not in info and abs(seen[:2]).max() < 1e-6
    env.close()


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ({"task": "contact:insert_pe"}, "did you mean `insert_peg`"),
        ({"steered": "MoveTo"}, "cannot be steered"),
        ({"steered": "Spiral"}, "cannot be steered"),
        ({"until": "SinkBelo"}, "there is no skill `SinkBelo`"),
        ({"reality": "wild"}, "wild"),
    ],
)
def test_what_cannot_be_steered_is_refused(arguments: dict[str, str], why: str) -> None:
    with pytest.raises(skillc.RequestError, match=why):
        SearchEnv(**arguments)  # type: ignore[arg-type]


@pytest.mark.sim
def test_a_task_without_the_search_says_so() -> None:
    with pytest.raises(skillc.SkillcError, match="ended before its search"):
        SearchEnv("contact:press_button").reset(seed=0)
