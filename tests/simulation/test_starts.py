"""Arms start where they touch nothing that is believed to be there; a first draw that is free is kept."""

from __future__ import annotations

import numpy as np
import pytest
from cells import vocabulary, world

from skillc_ontology import catalogue
from skillc_runtime.backends.simulation.arms import start_postures as starts
from skillc_runtime.backends.simulation.arms.start_postures import draw_start
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.backends.simulation.variation.variation import draw_variation
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_documents, sheet_documents

SEEDS = range(40)


def looking(arm: ArmSpec) -> CollisionChecker:
    assert arm.gripper is not None
    state, openings = arm.sheet.state, {arm.gripper.individual: arm.gripper.max_opening_m / 2}
    return CollisionChecker(
        build_collision_model(read_arm_assembly(state, arm.individual, openings), read_scenery(state, arm.base)),
        arm.home,
    )


def first_draw(arm: ArmSpec, seed: int) -> tuple[float, ...]:
    off = rng_for(arm.individual, seed).uniform(-1.0, 1.0, arm.home.size) * arm.posture_range_rad
    return tuple(off.tolist())


def arm_in(old: str, new: str) -> ArmSpec:
    text = catalogue.scene_path("iiwa_table").read_text("utf-8")
    assert text.count(old) == 1
    return read_scene_spec(
        load_documents([Document("scene.ttl", text.replace(old, new)), *sheet_documents()], vocabulary())
    ).arms[0]


def test_a_start_that_touches_something_is_drawn_again_and_no_other() -> None:
    (arm,) = read_scene_spec(world("iiwa_table")).arms
    contacts, again = looking(arm), 0
    for seed in SEEDS:
        first, start = first_draw(arm, seed), draw_start(arm, seed)
        free = not contacts.overlapping_pairs(arm.home + first)
        assert (start == first) == free
        assert not contacts.overlapping_pairs(arm.home + start)
        assert np.abs(start).max() <= arm.posture_range_rad
        assert start == draw_start(arm, seed)
        again += not free
    assert 0 < again < len(SEEDS) / 2


def test_an_arm_that_touches_something_wherever_it_is_drawn_starts_at_home(monkeypatch: pytest.MonkeyPatch) -> None:
    (arm,) = read_scene_spec(world("iiwa_table")).arms
    contacts = looking(arm)
    touching = next(seed for seed in SEEDS if contacts.overlapping_pairs(arm.home + first_draw(arm, seed)))
    monkeypatch.setattr(starts, "MAX_DRAWS", 1)
    assert draw_start(arm, touching) == (0.0,) * 7


def test_what_an_arm_touches_at_home_says_nothing_of_its_starts() -> None:
    arm = arm_in(
        "lab:Scene-1 a",
        "lab:Fog a skiros:Location ; skiros:at lab:Cell ; "
        "skiros:SizeX 6.0 ; skiros:SizeY 6.0 ; skiros:SizeZ 6.0 .\n\nlab:Scene-1 a",
    )
    contacts = looking(arm)
    assert contacts.overlapping_pairs(arm.home)
    assert draw_start(arm, SEEDS[0]) == first_draw(arm, SEEDS[0])


def test_an_arm_without_a_range_starts_at_home() -> None:
    assert draw_start(arm_in("skillc:postureRange 0.2 ;", ""), 1) == (0.0,) * 7


@pytest.mark.parametrize("scene", ["ur5e_whiteboard", "panda_desk"])
def test_where_there_is_room_nothing_is_drawn_again(scene: str) -> None:
    (arm,) = read_scene_spec(world(scene)).arms
    assert [draw_start(arm, seed) for seed in SEEDS[:10]] == [first_draw(arm, seed) for seed in SEEDS[:10]]


def test_an_arm_starts_clear_of_a_table_that_is_higher_than_it_is_believed_to_be() -> None:
    scene = read_scene_spec(world("iiwa_table"))
    ((arm,), (table,)) = scene.arms, scene.surfaces
    unsure_m, contacts = (
        table.offset_range_m + table.tilt_range_rad * float(np.hypot(*table.size[:2])) / 2,
        looking(arm),
    )
    at_home = contacts.overlapping_pairs(arm.home, unsure_m)
    nearer = [
        seed for seed in SEEDS if not contacts.overlapping_pairs(arm.home + first_draw(arm, seed), unsure_m) <= at_home
    ]
    assert 0 < len(nearer) < len(SEEDS) / 2
    for seed in nearer:
        assert (
            contacts.overlapping_pairs(arm.home + draw_variation(scene, seed).start_rad[arm.individual], unsure_m)
            <= at_home
        )
