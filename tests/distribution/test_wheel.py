"""The wheel, and what the Dockerfile installs, in clean environments outside the checkout: they check, compile, run."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

pytestmark = pytest.mark.wheel

ROOT = Path(__file__).parents[2]
CONSTRAINTS = ROOT / "constraints.txt"
LARGEST = 60_000_000
"""Bytes of what `pip install skillc` installs."""
OF_THE_GRAMMAR = (
    "dsl/test_syntax_cases.py",
    "dsl/test_syntax_examples.py",
    "dsl/test_syntax_grammar.py",
    "dsl/test_parser_tables.py",
    "dsl/test_cache.py",
    "compiler/test_error_cases.py",
    "compiler/test_compiling.py",
)
"""Tests in which lark has a part: of the grammar, and of the tables that it makes, and what is made of whole files."""
LIBRARY = """
use rparts
import "motion.skill"
prefix lab: <http://example.org/lab#>

## Take the home posture.
skill GoHome {
    in arm: ArmDevice
    noplan
}

impl directly of GoHome {
    do TakePosture(arm)
}

task go_home {
    scene "iiwa_table.ttl"
    do    GoHome(arm: lab:Iiwa-1)
}
"""


def call(*command: str | Path, cwd: Path, env: dict[str, str] | None = None) -> str:
    done = subprocess.run(
        [str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False, env=env or without_path()
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("dist")
    call(sys.executable, "-m", "build", "--wheel", "--installer", "uv", "--outdir", folder, ROOT, cwd=folder)
    return next(folder.glob("skillc-*.whl"))


def install(env: Path, *words: str | Path) -> None:
    """Install into an environment, which is made if it does not exist."""
    if not env.exists():
        venv.create(env, with_pip=False)
    call(uv(), "pip", "install", "-q", "--python", env / "bin/python", *words, cwd=env)


def test_the_wheel_works_in_a_clean_environment(tmp_path: Path, wheel: Path) -> None:
    check_contents(wheel)
    install(tmp_path / "env", "--compile-bytecode", "--constraint", CONSTRAINTS, wheel)  # as pip does
    python, skillc = tmp_path / "env/bin/python", tmp_path / "env/bin/skillc"
    files = [each for each in (tmp_path / "env").rglob("*") if each.is_file() and not each.is_symlink()]
    assert sum(each.stat().st_size for each in files) <= LARGEST
    assert any(each.name == "tables.msgpack" for each in files)
    assert call(python, "-m", "skillc", "--version", cwd=tmp_path) == call(skillc, "--version", cwd=tmp_path)
    assert "_skillc_completion" in call(skillc, "completion", "bash", cwd=tmp_path)
    library = tmp_path / "mine"
    library.mkdir()
    (library / "home.skill").write_text(LIBRARY, encoding="utf-8")
    (note,) = json.loads(call(skillc, "check", "--json", library, cwd=tmp_path))
    assert note["name"] == "unchecked-space"
    assert "A class does not exist" in call(skillc, "explain", "unknown-class", cwd=tmp_path)
    call(skillc, "compile", library, "-o", tmp_path / "build", cwd=tmp_path)
    assert json.loads((tmp_path / "build/library.json").read_text(encoding="utf-8"))["name"] == "mine"
    plan = json.loads(call(skillc, "plan", "clean_table", "--json", cwd=tmp_path))
    assert [step["skill"] for step in plan["plan"]] == ["Pick", "Wipe"]
    assert "A*" in plan["planner"]
    refused = subprocess.run([skillc, "run", "clean_table"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "pip install 'skillc[run]'" in refused.stderr, refused.stderr
    install(tmp_path / "env", "--constraint", CONSTRAINTS, f"{wheel}[run]")
    assert json.loads(call(skillc, "check", "--json", library, cwd=tmp_path)) == []
    result = json.loads(call(skillc, "run", "mine:go_home", "--json", cwd=tmp_path))
    assert result["status"] == "succeeded"
    assert result["sim_time_s"] > 0.1


def test_the_compiler_works_with_the_newest_lark_and_without_pddl(tmp_path: Path, wheel: Path) -> None:
    env = tmp_path / "env"
    install(env, "--upgrade", "lark>=1.2,<2", wheel, "pytest", "pytest-timeout", "pytest-asyncio", "hypothesis")
    selected = [ROOT / "tests" / each for each in OF_THE_GRAMMAR]
    options = ("-p", "no:cacheprovider", "--rootdir", ROOT, "-c", ROOT / "pyproject.toml")
    done = call(env / "bin/python", "-m", "pytest", *options, *selected, cwd=tmp_path, env=without_path())
    assert re.search(r"\.{40}", done)
    script = "import importlib.util as u, importlib.metadata as m; print(u.find_spec('pddl'), m.version('lark'))"
    missing, version = call(env / "bin/python", "-c", script, cwd=tmp_path, env=without_path()).split()
    assert missing == "None" and tuple(map(int, version.split(".")[:2])) >= (1, 2)


def check_contents(wheel: Path) -> None:
    """Check that a wheel has its licence, its author and addresses, and that each of its packages is typed."""
    with zipfile.ZipFile(wheel) as opened:
        names = opened.namelist()
        metadata = next(opened.read(each).decode() for each in names if each.endswith(".dist-info/METADATA"))
    assert any(each.endswith(".dist-info/licenses/LICENSE") for each in names)
    packages = {each.partition("/")[0] for each in names if ".dist-info" not in each}
    assert {f"{each}/py.typed" for each in packages} <= set(names)
    for line in ("Author: skillc contributors", "License-Expression: Apache-2.0", "Project-URL: Source, https://"):
        assert line in metadata


def test_what_the_dockerfile_installs_works(tmp_path: Path) -> None:
    lines = (ROOT / "Dockerfile").read_text("utf-8").splitlines()
    source, target = tmp_path / "src", tmp_path / "env"
    source.mkdir()
    ignore = shutil.ignore_patterns("__pycache__", "node_modules")
    for name in (each for line in lines if line.startswith("COPY ") for each in line.split()[1:-1]):
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, source / name, ignore=ignore)
        else:
            shutil.copy(ROOT / name, source)
    venv.create(target, with_pip=False)
    (install,) = (line.removeprefix("RUN ") for line in lines if line.startswith("RUN pip "))
    words = shlex.split(re.sub("^pip install --no-cache-dir", "install -q", install))
    call(uv(), "pip", words[0], "--python", target / "bin/python", *words[1:], cwd=source)
    (entry,) = (json.loads(line.removeprefix("ENTRYPOINT ")) for line in lines if line.startswith("ENTRYPOINT "))
    work = tmp_path / "work"
    work.mkdir()
    env = {**without_path(), "PATH": f"{target / 'bin'}:{os.environ['PATH']}"}
    program = shutil.which(entry[0], path=env["PATH"])
    assert program is not None and program.startswith(str(target))
    call(program, "new", "cell", "--template", "pick-place", cwd=work, env=env)
    assert json.loads(call(program, "run", "--json", cwd=work / "cell", env=env))["status"] == "succeeded"
    found = {each["name"]: each["found"] for each in json.loads(call(program, "doctor", "--json", cwd=work, env=env))}
    assert found["Fast Downward"] and found["av"] and found["CP-SAT"], found


def without_path() -> dict[str, str]:
    """Return the variables of the environment, without the paths of the checkout for modules and bytecode."""
    return {name: each for name, each in os.environ.items() if name not in ("PYTHONPATH", "PYTHONPYCACHEPREFIX")}


def uv() -> str:
    """Return the uv that set this checkout up, or the one on the path."""
    local = ROOT / ".tools/bin/uv"
    return str(local) if local.is_file() else "uv"
