"""`skillc scene import`: the solids of SDF, URDF and MJCF files stand where the files say; the rest is listed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation, rotation_from_angles
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.bodies import read_body
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
SEEDS = range(3)

WEDGE = "v 0 0 0\nv .2 0 0\nv .2 .1 0\nv 0 .1 0\nv 0 0 .1\nv 0 .1 .1\n" + "".join(
    f"f {face}\n" for face in ("1 4 3", "1 3 2", "1 2 5", "4 6 3", "1 5 6", "1 6 4", "2 3 6", "2 6 5")
)
SDF = '<sdf version="1.9"><world name="w">{}</world></sdf>'
SHAPE = '<model name="{0}"><link name="l"><collision name="c"><geometry>{1}</geometry></collision></link></model>'


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(skillc, ["scene", "new", "cell.ttl"]).exit_code == 0


def bring_in(name: str, text: str, *options: str) -> Result:
    Path(name).write_text(text, "utf-8")
    result = CliRunner().invoke(skillc, ["scene", "import", "cell.ttl", name, *options])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def loaded() -> WorldState:
    return load_scene(Path("cell.ttl"), libraries.load_vocabulary())


def agree(one: Pose, other: Pose) -> bool:
    return np.allclose(one.position, other.position, atol=1e-5) and np.allclose(one.rotation, other.rotation, atol=1e-5)


def numbers(values: object) -> str:
    return " ".join(f"{value:.9f}" for value in np.ravel(np.asarray(values, float)).tolist())


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("form", ["sdf", "urdf", "mjcf"])
def test_nested_boxes_stand_where_the_file_says(form: str, seed: int) -> None:
    chance = np.random.default_rng(seed)
    outer, inner = chance.uniform(-2, 2, (2, 3)), chance.uniform(-3, 3, (2, 3))
    (p, q), (a, b), extent = outer, inner, chance.uniform(0.1, 1.0, 3)
    expected = Pose(p, rotation_from_angles(*a)) @ Pose(q, rotation_from_angles(*b))
    box, turn = numbers(extent), numbers(quaternion_from_rotation(rotation_from_angles(*b)))
    texts = {
        "sdf": SDF.format(
            f'<model name="m"><pose>{numbers((p, a))}</pose><link name="base"><collision name="c">'
            f"<pose>{numbers((q, b))}</pose><geometry><box><size>{box}</size></box></geometry></collision>"
            "</link></model>"
        ),
        "urdf": f'<robot name="r"><link name="w"/><joint name="j" type="fixed"><parent link="w"/><child link="m-base"/>'
        f'<origin xyz="{numbers(p)}" rpy="{numbers(a)}"/></joint><link name="m-base"><collision><origin '
        f'xyz="{numbers(q)}" rpy="{numbers(b)}"/><geometry><box size="{box}"/></geometry></collision></link></robot>',
        "mjcf": f'<mujoco><compiler angle="radian" eulerseq="XYZ"/><worldbody><body name="m-base" pos="{numbers(p)}" '
        f'euler="{numbers(a)}"><geom type="box" pos="{numbers(q)}" quat="{turn}" size="{numbers(extent / 2)}"/></body>'
        "</worldbody></mujoco>",
    }
    result = bring_in(f"{form}.xml", texts[form])
    assert result.stderr == f"cell.ttl: 1 solid added from {form}.xml ({form.upper()})\n"
    state = loaded()
    assert agree(pose(state, f"{LAB}m-base"), expected)
    assert np.allclose(size(state, f"{LAB}m-base"), extent, atol=1e-6)


def test_the_origin_of_the_file_can_be_placed_and_names_stay_unique() -> None:
    text = SDF.format(SHAPE.format("ball", "<sphere><radius>0.1</radius></sphere>"))
    for number in ("1", "2"):
        assert (
            bring_in("a.sdf", text, "--position", number, "0", "0.1", "--frame", "cell", "--yaw", "90").exit_code == 0
        )
    state = loaded()
    assert pose(state, f"{LAB}ball-l").position.tolist() == [1.0, 0.0, 0.1]
    assert pose(state, f"{LAB}ball-l-2").position.tolist() == [2.0, 0.0, 0.1]
    wrong = bring_in("a.sdf", text, "--on", "Cell")
    assert wrong.exit_code == 2 and "--position" in wrong.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("shape", "volume", "extent"),
    [
        ("<box><size>0.1 0.2 0.3</size></box>", 0.006, (0.1, 0.2, 0.3)),
        ("<sphere><radius>0.1</radius></sphere>", 4 / 3 * np.pi * 1e-3, (0.2, 0.2, 0.2)),
        ("<cylinder><radius>0.1</radius><length>0.5</length></cylinder>", np.pi * 0.005, (0.2, 0.2, 0.5)),
        (
            "<capsule><radius>0.1</radius><length>0.5</length></capsule>",
            np.pi * (0.005 + 4 / 3 * 1e-3),
            (0.2, 0.2, 0.7),
        ),
        ("<mesh><uri>wedge.obj</uri><scale>2 1 1</scale></mesh>", 0.002, (0.4, 0.1, 0.1)),
    ],
)
def test_shapes_have_the_bodies_that_the_file_means(shape: str, volume: float, extent: tuple[float, ...]) -> None:
    Path("wedge.obj").write_text(WEDGE, "utf-8")
    assert bring_in("a.sdf", SDF.format(SHAPE.format("thing", shape))).exit_code == 0
    body = read_body(loaded(), f"{LAB}thing-l")
    assert body is not None and not body.movable
    assert np.allclose(body.size, extent, atol=1e-6)
    assert sum(each.volume for each in body.solids) == pytest.approx(volume, rel=1e-3)


def test_what_is_not_understood_is_listed() -> None:
    result = bring_in(
        "bench.xml",
        '<mujoco><worldbody><light/><geom name="floor" type="plane" size="1 1 1"/><body name="bench"><geom type="box" '
        'size="1 1 1"/><geom name="egg" type="ellipsoid" size="1 2 1"/><geom name="look" type="sphere" size="1" '
        'contype="0" conaffinity="0"/></body><body name="drawer"><joint name="slide" type="slide"/>'
        '<geom size="1"/></body></worldbody></mujoco>',
    )
    assert result.exit_code == 0
    assert [line.strip() for line in result.stderr.splitlines()] == [
        "cell.ttl: 2 solids added from bench.xml (MJCF)",
        "left out, only visible beside what collides: look",
        "left out, planes, because a scene has its floor at z = 0: floor",
        "left out, shapes that bodies cannot have: egg (ellipsoid)",
        "joints: what they move is fixed where it starts: slide",
        "left out: 1 light",
    ]
    shape = SHAPE.format("a", "<box><size>1 1 1</size></box>")
    others = SHAPE.format("cone", "<cone/>") + SHAPE.format("m", "<mesh><uri>model://a/b.dae</uri></mesh>")
    moved = '<model name="far"><pose relative_to="a">1 0 0 0 0 0</pose></model><include/><light name="sun"/>'
    told = bring_in("a.sdf", SDF.format(shape + others + moved)).stderr
    wanted = (
        "w/m/l/c: the mesh model://a/b.dae",
        "w/far: its pose is relative to a",
        "<cone>: w/cone",
        "<include>",
        "sun",
    )
    assert all(each in told for each in wanted), told


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("a.sdf", "no XML", "is not XML"),
        ("a.sdf", "<html/>", "its root is <html>"),
        ("a.sdf", SDF.format(""), "has no solids"),
        ("a.sdf", SDF.format(SHAPE.format("a", "<box><size>1 1</size></box>")), "<size> of a <box> has 2 numbers"),
        ("a.sdf", SDF.format(SHAPE.format("a", "<sphere><radius>-1</radius></sphere>")), "cannot be read as SDF"),
        ("a.urdf", '<robot name="r"><link name="a"><visual/></link></robot>', "cannot be read as URDF"),
        ("a.xml", '<mujoco><worldbody><geom type="bx" size="1 1 1"/></worldbody></mujoco>', "cannot be read as MJCF"),
    ],
)
def test_a_file_that_cannot_be_read_changes_nothing(name: str, text: str, reason: str) -> None:
    before = Path("cell.ttl").read_bytes()
    result = bring_in(name, text)
    assert result.exit_code == 1 and reason in result.stderr and "Traceback" not in result.stderr
    assert Path("cell.ttl").read_bytes() == before


def test_a_file_that_is_not_there_is_said_to_be_missing() -> None:
    result = CliRunner().invoke(skillc, ["scene", "import", "cell.ttl", "none.sdf"])
    assert result.exit_code == 1 and "none.sdf is missing" in result.stderr
