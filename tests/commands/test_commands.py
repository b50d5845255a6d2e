"""The command line as a user meets it: forms, exit codes, JSON, errors without a traceback."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_ontology import catalogue

LIBRARY = """
use skiros, rparts
skill Fetch {
    in    arm:     ArmDevice
    infer gripper: GripperEffector
    in    object:  Product
    pre   arm hasA gripper
    post  gripper contain object
}
"""


def run(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(skillc, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


@pytest.fixture
def library(tmp_path: Path) -> Path:
    folder = tmp_path / "lab"
    folder.mkdir()
    (folder / "fetch.skill").write_text(LIBRARY, encoding="utf-8")
    return folder


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    return Path(shutil.copy(catalogue.scene_path("iiwa_table.ttl"), tmp_path / "scene.ttl"))


def edited(scene: Path, old: str, new: str) -> Path:
    text = scene.read_text(encoding="utf-8")
    assert old in text
    scene.write_text(text.replace(old, new), encoding="utf-8")
    return scene


def test_help_lists_every_command() -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert all(f"  {name} " in result.stdout for name in ("check", "compile", "plan", "run", "world", "demo", "doctor"))


def test_an_unknown_command_is_named_with_those_that_exist() -> None:
    result = run("complie")
    assert result.exit_code == 2
    assert "there is no command `complie`" in result.stderr
    assert "did you mean `compile`?" in result.stderr


def test_check_of_a_sound_library_says_so_and_exits_0(library: Path) -> None:
    result = run("check", library, "--format", "concise")
    assert result.exit_code == 0
    assert "error" not in result.stdout


def test_check_reports_every_error_as_json(library: Path) -> None:
    (library / "bad.skill").write_text("use skiros\nskill A { in x: Prodct }\nskill B { in y: 3 }\n", encoding="utf-8")
    result = run("check", library, "--json")
    found = json.loads(result.stdout)
    assert result.exit_code == 1
    assert {(each["line"], each["severity"]) for each in found if each["path"].endswith("bad.skill")} >= {
        (2, "error"),
        (3, "error"),
    }
    assert set(found[0]) == {
        "name", "severity", "path", "line", "column", "end_line", "end_column", "message", "help", "labels", "fix",
    }  # fmt: skip


def test_a_path_that_does_not_exist_is_a_usage_error() -> None:
    result = run("check", "nowhere.skill")
    assert result.exit_code == 2
    assert "there is no file or folder nowhere.skill" in result.stderr


def test_compile_writes_all_artifacts_twice_the_same(library: Path, tmp_path: Path) -> None:
    first, second = tmp_path / "one", tmp_path / "two"
    assert run("compile", library, "-o", first).exit_code == 0
    assert run("compile", library, "-o", second).exit_code == 0
    files = sorted(path.relative_to(first) for path in first.rglob("*") if path.is_file())
    assert {"library.json", "skills.ttl", "domain.pddl", "domain.temporal.pddl"} <= {str(path) for path in files}
    assert all((first / path).read_bytes() == (second / path).read_bytes() for path in files)


def test_compile_of_a_broken_library_writes_nothing(library: Path, tmp_path: Path) -> None:
    (library / "bad.skill").write_text("skill A { in x: Nothing }", encoding="utf-8")
    result = run("compile", library, "-o", tmp_path / "build")
    assert result.exit_code == 1
    assert "unknown-class" in result.stderr
    assert not (tmp_path / "build").exists()


def test_a_scene_with_an_unknown_class_is_refused_with_its_line(library: Path, scene: Path) -> None:
    edited(scene, "a wiping:TableTop", "a wiping:TableTopp")
    result = run("check", library, "--scene", scene, "--format", "concise")
    line = next(n for n, text in enumerate(scene.read_text().splitlines(), 1) if "TableTopp" in text)
    assert result.exit_code == 1
    assert f"{scene}:{line}:" in result.stdout
    assert "TableTop" in result.stdout


def test_what_a_task_names_is_looked_up_in_its_scene(library: Path) -> None:
    (library / "tasks.skill").write_text(
        """prefix lab: <http://example.org/lab#>
import "wiping/wipe.skill"
task one {
    scene "iiwa_table.ttl"
    do    Wipe(surface: lab:Tabel-1)
}
task two {
    scene "iiwa_tabel.ttl"
    do    Wipe(surface: lab:Table-1)
}
""",
        encoding="utf-8",
    )
    found = json.loads(run("check", library, "--json").stdout)
    errors = [(each["line"], each["help"]) for each in found if each["severity"] == "error"]
    assert [line for line, _ in errors] == [5, 8]
    assert "lab:Table-1" in errors[0][1]
    assert "iiwa_table.ttl" in errors[1][1]


def test_a_truncated_scene_is_refused(library: Path, scene: Path) -> None:
    scene.write_text(scene.read_text(encoding="utf-8")[:1500], encoding="utf-8")
    result = run("check", library, "--scene", scene, "--format", "concise")
    assert result.exit_code == 1
    assert str(scene) in result.stdout


def test_plan_finds_the_optimal_plan_of_the_shipped_task() -> None:
    result = run("plan", "clean_whiteboard", "--json")
    answer = json.loads(result.stdout)
    assert result.exit_code == 0
    assert [step["skill"] for step in answer["plan"]] == ["Drive", "Pick", "Drive", "Wipe"]
    assert answer["plan_optimal"] is True


def test_plan_takes_a_pddl_goal(scene: Path) -> None:
    result = run("plan", "--scene", scene, "--goal", "(skiros:contain lab:Robotiq-1 lab:Eraser-1)", "--json")
    assert [step["skill"] for step in json.loads(result.stdout)["plan"]] == ["Pick"]


def test_a_goal_about_an_individual_that_does_not_exist_is_explained(scene: Path) -> None:
    result = run("plan", "--scene", scene, "--goal", "lab:Tabel-1.isClean == true")
    assert result.exit_code == 1
    assert "lab:Tabel-1" in result.stderr
    assert "lab:Table-1" in result.stderr


def test_without_an_eraser_there_is_no_plan_and_the_answer_says_why(scene: Path) -> None:
    text = scene.read_text(encoding="utf-8")
    start, end = text.index("lab:Eraser-1 a wiping:Eraser"), text.index("# --- the surface")
    scene.write_text((text[:start] + text[end:]).replace("lab:Eraser-1, ", ""), encoding="utf-8")
    result = run("run", "--scene", scene, "--goal", "lab:Table-1.isClean == true", "--json")
    answer = json.loads(result.stdout)
    assert result.exit_code == 3
    assert answer["status"] == "refused"
    assert "Eraser" in answer["failure"]


def test_a_gripper_without_implementation_is_refused_before_anything_moves(scene: Path) -> None:
    edited(scene, "a skillc:RobotiqGripper", "a skillc:ThreeFingerGripper")
    result = run("run", "--scene", scene, "--goal", "lab:Table-1.isClean == true", "--json")
    answer = json.loads(result.stdout)
    assert result.exit_code == 3
    assert answer["status"] == "refused"
    assert "ActuateGripper" in answer["failure"]
    assert "RobotiqGripper" in answer["failure"]


def test_an_unknown_task_is_named_with_those_that_exist() -> None:
    result = run("plan", "clean_whitebord")
    assert result.exit_code == 2
    assert "clean_whiteboard" in result.stderr


def test_world_lists_and_queries(scene: Path) -> None:
    listed = json.loads(run("world", scene, "--json").stdout)
    arm = next(each for each in listed if each["individual"] == "lab:Iiwa-1")
    assert arm["properties"]["skiros:CompliantController"] == "impedance"
    asked = run("world", scene, "--query", "SELECT ?s WHERE { ?s wiping:normalForce ?f FILTER(?f > 10) }")
    assert asked.stdout.split() == ["s", "lab:Table-1"]


def test_world_lists_the_scene_itself_with_its_labels_unless_all_is_asked(scene: Path) -> None:
    own, everything = run("world", scene).stdout, run("world", scene, "--all").stdout
    assert 'lab:Table-1  "rough table"  a wiping:TableTop' in own
    assert "skillc:ur5e-sheet  a" in everything
    assert "skillc:ur5e-sheet  a" not in own
    listed = json.loads(run("world", scene, "--json").stdout)
    assert {each["individual"].partition(":")[0] for each in listed} == {"lab"}
    assert {"individual": "lab:Table-1", "label": "rough table"}.items() <= listed[-1].items()


def test_answers_in_json_are_typed(scene: Path) -> None:
    sparql = (
        "SELECT ?p ?v { lab:Table-1 ?p ?v FILTER(?p IN (wiping:isClean, wiping:normalForce, rdf:type)) } ORDER BY ?p"
    )
    rows = json.loads(run("world", scene, "--query", sparql, "--json").stdout)
    assert {row["p"]: row["v"] for row in rows} == {
        "rdf:type": "wiping:TableTop",
        "wiping:isClean": False,
        "wiping:normalForce": 18.0,
    }


def test_the_query_that_help_recommends_includes_subclasses(scene: Path) -> None:
    written = " ".join(run("world", "--help").stdout.split())
    pattern = written.partition("ask for `")[2].partition("`")[0]
    assert run("world", scene, "--query", f"SELECT ?x {{ {pattern} }}").stdout.split() == ["x", "lab:Iiwa-1"]


def test_a_query_that_is_not_sparql_is_explained(scene: Path) -> None:
    result = run("world", scene, "--query", "SELEC ?s")
    assert result.exit_code == 1
    assert "not SPARQL" in result.stderr
    assert result.stderr.endswith("\n  SELEC ?s\n  ^\n")


@pytest.mark.slow
def test_a_query_that_takes_too_long_is_ended(scene: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc.services.views.scenes.QUERY_LIMIT_S", 0.2)
    pairs = " . ".join(f"?a{n} ?b{n} ?c{n}" for n in range(12))
    result = run("world", scene, "--query", f"SELECT (COUNT(*) AS ?n) {{ {pairs} }}")
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr == "error: the query was ended after 0.2 s; ask for less\n"


def test_a_federated_query_is_refused_without_the_network(scene: Path) -> None:
    result = run("world", scene, "--query", "SELECT ?x { SERVICE <http://a.invalid/> { ?x ?p ?y } }")
    assert result.exit_code == 1
    assert "do not use the network" in result.stderr


@pytest.mark.parametrize("content", [bytes(range(255, -1, -1)) * 2, "lab:ä".encode("utf-16")])
def test_a_scene_that_is_not_utf_8_is_one_clear_error(library: Path, tmp_path: Path, content: bytes) -> None:
    scene = tmp_path / "binary.ttl"
    scene.write_bytes(content)
    expected = f"error[unreadable-scene]: cannot read {scene}: it is "
    shown, checked = run("world", scene), run("check", library, "--scene", scene)
    assert shown.exit_code == 1 and shown.stderr.startswith(expected) and shown.stderr.count("error[") == 1
    assert "not UTF-8" in shown.stderr
    assert checked.exit_code == 1 and checked.stdout.startswith(expected) and checked.stdout.count("error[") == 1
