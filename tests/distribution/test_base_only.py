"""Without extras one can check, format, compile, plan and edit; each command that needs more names the extra."""

from __future__ import annotations

import json
import re
import shutil
import tomllib
from pathlib import Path

import pytest

from distribution.base_only import ROOT, call, hidden_modules
from skillc.extras import MODULES

FORMER = {"fast", "video", "editor"}
COMMAND = re.compile(r"pip install 'skillc\[([a-z,]+)\]'")
NEEDS = {
    "run": "run",
    "trials clean_table": "run",
    "learn clean_table --minimise time": "run",
    "demo": "run",
    "replay runs": "run",
    "report runs": "run",
    "diff runs others": "run",
    "scene show cell.ttl": "run",
    "run --signals parquet --out runs": "run",
    "serve": "server,run",
    "studio": "server,run",
    "ps": "server",
    "start clean_table": "server",
    "logs x": "server",
    "add robot arm.urdf": "robots",
}
"""Commands in a project, and the extras that each of them names."""
PROGRAM = """
import skillc
from skillc.extras import MissingExtraError

assert skillc.plan("clean_table").steps
(note,) = skillc.check(".")
print(note.severity, note.name)
for call in (lambda: skillc.run("clean_table"), lambda: skillc.trials("clean_table"), lambda: skillc.connect()):
    try:
        call()
    except MissingExtraError as error:
        assert isinstance(error, skillc.SkillcError)
        print(error)
"""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("base")
    done = call(folder, "-m", "skillc", "new", "cell", "--template", "pick-place")
    assert done.returncode == 0, done.stderr
    return folder / "cell"


def test_the_extras_are_those_of_the_package() -> None:
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["optional-dependencies"]
    assert declared.keys() - FORMER - {"all", "studio", "docs", "dev"} == MODULES.keys()
    assert all(each in ([], ["skillc[run]"]) for each in map(declared.get, FORMER))


def test_what_is_hidden_is_all_that_is_not_in_the_base() -> None:
    hidden = hidden_modules()
    assert {"numpy", "mujoco", "rich", "pddl", "matplotlib", "httpx"} <= hidden
    assert hidden.isdisjoint(("click", "lark", "msgspec", "pyoxigraph", "pygls", "lsprotocol", "attr", "markupsafe"))


def test_a_library_without_scenes_is_checked_without_extras(tmp_path: Path) -> None:
    shutil.copy(ROOT / "skills_src/skillc_skills/std/gripper.skill", tmp_path)
    done = call(tmp_path, "-m", "skillc", "check")
    assert done.returncode == 0 and done.stderr.endswith("no problems\n"), done.stdout + done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        "fmt --check .",
        "compile -o build",
        "explain out-of-reach",
        "plan",
        "plan sorting:sort_shapes",
        "doc -o site",
        "tasks",
        "world cell.ttl",
        "doctor",
        "lock",
    ],
)
def test_the_commands_of_the_base_work_without_extras(words: str, project: Path) -> None:
    done = call(project, "-m", "skillc", *words.split())
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stdout + done.stderr


@pytest.mark.slow
def test_a_check_says_in_a_note_that_it_did_not_look_at_space(project: Path) -> None:
    done = call(project, "-m", "skillc", "check", "--json")
    (note,) = json.loads(done.stdout)
    assert (done.returncode, note["name"], note["severity"]) == (0, "unchecked-space", "note")
    assert COMMAND.search(note["help"])
    assert call(project, "-m", "skillc", "check", "--format", "github").stdout.startswith("::notice file=cell.ttl")
    assert "1 note in 1 file" in call(project, "-m", "skillc", "check").stderr


@pytest.mark.slow
@pytest.mark.parametrize(("words", "extras"), NEEDS.items())
def test_a_command_names_the_extra_that_it_needs(words: str, extras: str, project: Path) -> None:
    done = call(project, "-m", "skillc", *words.split())
    found = COMMAND.search(done.stderr)
    assert done.returncode == 2 and found, done.stdout + done.stderr
    assert found[1] == extras and set(extras.split(",")) <= MODULES.keys()
    assert len(done.stderr.splitlines()) == 1 and not (project / "runs").exists()


@pytest.mark.slow
def test_functions_of_the_api_work_or_name_the_extra(project: Path) -> None:
    done = call(project, "-c", PROGRAM)
    assert done.returncode == 0, done.stderr
    note, *refused = done.stdout.splitlines()
    assert note == "note unchecked-space"
    assert [COMMAND.search(each)[1] for each in refused] == ["run", "run", "server"]  # type: ignore[index]


@pytest.mark.slow
def test_editors_get_diagnostics_and_the_note_without_extras(project: Path) -> None:
    file = project / "cell.skill"
    item = {"uri": file.as_uri(), "languageId": "skill", "version": 1, "text": file.read_text("utf-8") + "\nskill\n"}
    started = {"processId": None, "rootUri": project.as_uri(), "capabilities": {}}
    asked = {"textDocument": {"uri": file.as_uri()}}
    sent = (
        _message("initialize", started, 1),
        _message("initialized", {}),
        _message("textDocument/didOpen", {"textDocument": item}),
        _message("textDocument/documentSymbol", asked, 2),
        _message("skillc/runTest", {**asked, "name": "none"}, 4),
        _message("shutdown", None, 3),
        _message("exit", None),
    )
    done = call(project, "-m", "skillc", "lsp", given="".join(sent))
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
    assert '"id":2,' in done.stdout.replace(" ", "") and "ModuleNotFound" not in done.stdout
    assert COMMAND.search(done.stdout), "what a test needs is not named"


def _message(method: str, params: object, number: int | None = None) -> str:
    body = json.dumps({"jsonrpc": "2.0", "method": method, "params": params} | ({"id": number} if number else {}))
    return f"Content-Length: {len(body.encode())}\r\n\r\n{body}"
