"""With the looks of a collection devices are drawn with its meshes, in the right places; the physics is the same."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from cells import vocabulary
from menagerie import COLOUR, OURS, QUARTERS, SCALE, tetrahedron, write_collection

from skillc_dsl.cache import VARIABLE
from skillc_ontology import catalogue
from skillc_runtime.backends.simulation.model.drawing import ModelDrawing
from skillc_runtime.backends.simulation.model.model_builder import build_model, describe_model
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import draw_variation
from skillc_runtime.film.look_cache import model_file
from skillc_runtime.film.look_meshes import add_looks
from skillc_runtime.film.looks import Collection, Looks, LooksError, read_looks
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.scene.load import load_scene

SCENES = {"ur5e_whiteboard": ["ur5e"], "iiwa_table": ["iiwa14"], "panda_desk": ["panda_nohand", "hand"]}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache; what is not in it cannot be fetched, for Git has nothing but files."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    monkeypatch.setenv("GIT_ALLOW_PROTOCOL", "file")
    return tmp_path / "cache"


def seen(scene: str) -> tuple[SceneSpec, Looks]:
    state = load_scene(catalogue.scene_path(scene), vocabulary())
    facts = read_scene_spec(state)
    return facts, read_looks(state, prefixes(facts), "menagerie")


def prefixes(facts: SceneSpec) -> Mapping[str, str]:
    reality = draw_variation(facts, 3)
    return ModelDrawing(facts, reality, build_model(facts, reality), None).prefixes


def folder_of(cache: Path, collection: Collection) -> Path:
    return cache / "looks" / collection.name / collection.commit


def spec_of(facts: SceneSpec) -> mujoco.MjSpec:
    return describe_model(facts, draw_variation(facts, 3))


def corners(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Array:
    """Return where the corners of a mesh are, in the world, sorted."""
    mesh = model.geom_dataid[geom]
    first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    vertices = model.mesh_vert[first : first + count] @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    return vertices[np.lexsort(vertices.round(6).T)]


@pytest.mark.parametrize("scene", SCENES)
def test_meshes_are_where_the_collection_s_own_model_has_them(scene: str, cache: Path) -> None:
    facts, looks = seen(scene)
    write_collection(folder_of(cache, looks.collection))
    model = add_looks(spec_of(facts), looks).compile()
    data, compared = mujoco.MjData(model), 0
    data.qpos[:] += np.random.default_rng(4).uniform(0.0, 0.04, model.nq)
    mujoco.mj_kinematics(model, data)
    assert [Path(look.model).stem for look in looks.looks] == SCENES[scene]
    for look in looks.looks:
        file = folder_of(cache, looks.collection) / look.model
        theirs = mujoco.MjModel.from_xml_path(str(file))
        posed = mujoco.MjData(theirs)
        own = [j for j in range(model.njnt) if model.joint(j).name.startswith(f"{look.device}/")]
        posed.qpos[:] = data.qpos[model.jnt_qposadr[own]]
        mujoco.mj_kinematics(theirs, posed)
        mounted = _mount(model, data, look.device) @ _turn(OURS[look.model])
        for geom in np.flatnonzero(theirs.geom_type == mujoco.mjtGeom.mjGEOM_MESH):
            name = theirs.mesh(theirs.geom_dataid[geom]).name
            (drawn,) = (g for g in range(model.ngeom) if _mesh_name(model, g) == f"{look.device}/look/{name}")
            expected = np.array([mounted.apply(corner) for corner in corners(theirs, posed, geom)])
            expected = expected[np.lexsort(expected.round(6).T)]
            np.testing.assert_allclose(corners(model, data, drawn), expected, atol=1e-6)
            assert np.ptp(expected, axis=0).max() > 0.2 * SCALE
            np.testing.assert_allclose(model.geom_rgba[drawn], [float(part) for part in COLOUR.split()])
            compared += 1
        assert not any(model.geom(g).name.startswith(f"{look.device}/") for g in range(model.ngeom)), "own shapes"
    assert compared >= 7


def _mesh_name(model: mujoco.MjModel, geom: int) -> str:
    return model.mesh(model.geom_dataid[geom]).name if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH else ""


def _mount(model: mujoco.MjModel, data: mujoco.MjData, device: str) -> Pose:
    """Return where a device is mounted: its outermost body; all of ours have their frames there."""
    body = next(b for b in range(model.nbody) if model.body(b).name.startswith(f"{device}/"))
    return Pose(data.xpos[body], data.xmat[body].reshape(3, 3))


def _turn(ours: str) -> Pose:
    return Pose(np.zeros(3), exp(np.array([0.0, 0.0, QUARTERS.get(ours, 0) * np.pi / 2])))


@pytest.mark.parametrize("scene", SCENES)
def test_looks_weigh_nothing_and_touch_nothing(scene: str, cache: Path) -> None:
    facts, looks = seen(scene)
    write_collection(folder_of(cache, looks.collection))
    plain, drawn = build_model(facts, draw_variation(facts, 3)), add_looks(spec_of(facts), looks).compile()
    for name in ("body_mass", "body_inertia", "body_ipos", "body_iquat", "jnt_axis", "dof_armature", "qpos0"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(drawn, name))
    meshes = drawn.geom_type == mujoco.mjtGeom.mjGEOM_MESH
    assert meshes.sum() >= 7
    assert not drawn.geom_contype[meshes].any() and not drawn.geom_conaffinity[meshes].any()


def test_a_model_that_moves_otherwise_is_refused(cache: Path) -> None:
    facts, looks = seen("iiwa_table")
    folder = folder_of(cache, looks.collection)
    write_collection(folder)
    file = folder / looks.looks[0].model
    text = file.read_text("utf-8")
    file.write_text(text.replace('type="hinge"', 'type="slide"', 1), "utf-8")
    with pytest.raises(LooksError, match=r"kuka_iiwa_14/iiwa14.xml does not move as lab:Iiwa-1 does"):
        add_looks(spec_of(facts), looks)
    (foreign,) = (replace(look, model="universal_robots_ur5e/ur5e.xml") for look in looks.looks)
    with pytest.raises(LooksError, match=r"ur5e.xml has 6 joints and lab:Iiwa-1 has 7"):
        add_looks(spec_of(facts), replace(looks, looks=(foreign,)))
    file.write_text("<mujoco", "utf-8")
    with pytest.raises(LooksError, match=r"iiwa14.xml cannot be read"):
        add_looks(spec_of(facts), looks)


def test_a_missing_mesh_is_named(cache: Path) -> None:
    facts, looks = seen("iiwa_table")
    folder = folder_of(cache, looks.collection)
    write_collection(folder)
    (folder / "kuka_iiwa_14/assets/iiwa14_3.obj").unlink()
    with pytest.raises(LooksError, match=r"(?s)kuka_iiwa_14/iiwa14.xml cannot be used.*iiwa14_3.obj"):
        add_looks(spec_of(facts), looks)


def test_looks_that_there_are_not_are_told_with_those_there_are() -> None:
    state = load_scene(catalogue.scene_path("iiwa_table"), vocabulary())
    with pytest.raises(LooksError, match="no looks menagery; there are primitive, menagerie"):
        read_looks(state, prefixes(read_scene_spec(state)), "menagery")
    with pytest.raises(LooksError, match="menagerie has no model of any device in this scene"):
        read_looks(state, {}, "menagerie")


def test_what_cannot_be_fetched_is_told_with_what_to_put_where(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _, looks = seen("iiwa_table")
    where = folder_of(cache, looks.collection)
    with pytest.raises(LooksError) as told:
        model_file(looks.collection, "kuka_iiwa_14/iiwa14.xml")
    assert "cannot be fetched: transport 'https' not allowed" in str(told.value)
    assert f"put the folder kuka_iiwa_14 of {looks.collection.repository} at commit" in str(told.value)
    assert str(told.value).endswith(str(where))
    assert list(where.iterdir()) == []
    monkeypatch.setenv("PATH", "")
    with pytest.raises(LooksError, match="cannot be fetched: git is not installed"):
        model_file(looks.collection, "kuka_iiwa_14/iiwa14.xml")


def git(folder: Path, *words: str) -> str:
    names = ("-c", "user.name=Somebody", "-c", "user.email=somebody@example.org")
    clean = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    done = subprocess.run(["git", *names, *words], cwd=folder, env=clean, capture_output=True, text=True, check=True)
    return done.stdout.strip()


@pytest.fixture
def published(tmp_path: Path) -> Collection:
    """A repository whose newest commit is not the one that is wanted."""
    folder = tmp_path / "published"
    write_collection(folder)
    git(folder, "init", "--quiet")
    for setting in ("uploadpack.allowFilter", "uploadpack.allowAnySHA1InWant"):
        git(folder, "config", setting, "true")
    git(folder, "add", ".")
    git(folder, "commit", "--quiet", "-m", "wanted")
    wanted = git(folder, "rev-parse", "HEAD")
    tetrahedron(folder / "kuka_iiwa_14/assets/later.obj")
    git(folder, "add", ".")
    git(folder, "commit", "--quiet", "-m", "later")
    return Collection("own", folder.as_uri(), wanted)


def test_a_folder_is_fetched_once_as_it_is_at_the_commit(cache: Path, published: Collection, tmp_path: Path) -> None:
    file = model_file(published, "kuka_iiwa_14/iiwa14.xml")
    assert file == folder_of(cache, published) / "kuka_iiwa_14/iiwa14.xml"
    assert mujoco.MjModel.from_xml_path(str(file)).njnt == 7
    assert not (file.parent / "assets/later.obj").exists()
    assert sorted(path.name for path in folder_of(cache, published).iterdir()) == ["kuka_iiwa_14"]
    (tmp_path / "published").rename(tmp_path / "gone")
    assert model_file(published, "kuka_iiwa_14/iiwa14.xml") == file
    with pytest.raises(LooksError, match=r"(?s)cannot be fetched: .*universal_robots_ur5e"):
        model_file(published, "universal_robots_ur5e/ur5e.xml")


def test_a_folder_that_the_collection_has_not_is_told(cache: Path, published: Collection) -> None:
    with pytest.raises(LooksError, match=f"own has no folder kuka at commit {published.commit}"):
        model_file(published, "kuka/iiwa14.xml")
    with pytest.raises(LooksError, match=r"there is no iiwa\.xml in .*kuka_iiwa_14; remove that folder"):
        model_file(published, "kuka_iiwa_14/iiwa.xml")
    assert folder_of(cache, published).is_dir()


def test_a_commit_that_the_repository_has_not_is_told(cache: Path, published: Collection) -> None:
    with pytest.raises(LooksError, match="cannot be fetched"):
        model_file(replace(published, commit="1" * 40), "kuka_iiwa_14/iiwa14.xml")
    assert not any(cache.rglob("*.xml"))


def test_a_cache_that_cannot_be_written_is_told(
    tmp_path: Path, published: Collection, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "file"))
    with pytest.raises(LooksError, match=r"cannot write to .*file/looks/own"):
        model_file(published, "kuka_iiwa_14/iiwa14.xml")
