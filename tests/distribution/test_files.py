"""What other tools read about the project: metadata, workflows, hooks, container files, the citation, the extension."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

from waiting import LONG_S

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
PACKAGES = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]["build"]["targets"]["wheel"]
BIN = Path(sys.executable).parent
WORKFLOW = ROOT / ".github/workflows/ci.yml"
TEMPLATE = ROOT / "app/skillc/services/scaffolding/templates/common/check.yml.j2"


def call(*command: str | Path, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(each) for each in command], cwd=cwd, capture_output=True, text=True, check=False, timeout=LONG_S
    )


@pytest.mark.parametrize("package", PACKAGES["packages"])
def test_each_package_says_that_it_is_typed(package: str) -> None:
    assert (ROOT / package / "py.typed").is_file()


@pytest.mark.slow
@pytest.mark.parametrize("workflow", [WORKFLOW, TEMPLATE], ids=["project", "users"])
def test_workflows_are_of_the_schema(workflow: Path, tmp_path: Path) -> None:
    check = (BIN / "check-jsonschema", "--builtin-schema", "vendor.github-workflows", "--default-filetype", "yaml")
    done = call(*check, workflow)
    assert done.returncode == 0, done.stdout
    broken = tmp_path / "broken.yml"
    broken.write_text(workflow.read_text("utf-8").replace("runs-on:", "runs_on:"), "utf-8")
    assert call(*check, broken).returncode == 1


def test_the_package_promises_what_has_been_run_and_the_workflow_has_it() -> None:
    matrix = yaml.safe_load(WORKFLOW.read_text("utf-8"))["jobs"]["fast"]["strategy"]["matrix"]
    promised = [each for each in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", each)]
    assert {each.rpartition(" ")[2] for each in promised} <= set(matrix["python"])
    assert [each for each in PROJECT["classifiers"] if "System ::" in each] == ["Operating System :: POSIX :: Linux"]
    assert "**Nothing has\nbeen run there yet**" in (ROOT / "docs/platforms.md").read_text("utf-8")
    assert PROJECT["requires-python"] == f">={matrix['python'][0]}"
    assert matrix["os"] == ["ubuntu-latest", "macos-latest", "windows-latest"]


@pytest.mark.parametrize("file", [WORKFLOW, TEMPLATE, ROOT / "Dockerfile"], ids=lambda each: each.name)
def test_extras_that_are_installed_exist(file: Path) -> None:
    named = re.findall(r"(?:\.|whl|\))\[([a-z,]+)\]", file.read_text("utf-8"))
    assert named
    assert {each for extras in named for each in extras.split(",")} <= set(PROJECT["optional-dependencies"])


def test_the_image_copies_all_that_the_package_is_built_from() -> None:
    copied = {part for each in copied_into_image() for part in each[:-1]}
    assert {each.partition("/")[0] for each in PACKAGES["packages"]} <= copied
    assert {"pyproject.toml", "constraints.txt", PROJECT["readme"], *PROJECT["license-files"]} <= copied
    kept = {line[1:] for line in (ROOT / ".dockerignore").read_text("utf-8").splitlines() if line.startswith("!")}
    assert kept == copied and all((ROOT / each).exists() for each in copied)


def copied_into_image() -> list[list[str]]:
    """Return the words of each COPY of the Dockerfile: sources, then the target."""
    lines = (ROOT / "Dockerfile").read_text("utf-8").splitlines()
    return [line.split()[1:] for line in lines if line.startswith("COPY ")]


def test_the_dev_container_calls_targets_that_exist() -> None:
    container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text("utf-8"))
    targets = container["postCreateCommand"].split()[1:]
    assert targets and all(re.search(rf"(?m)^{re.escape(each)}:", (ROOT / "Makefile").read_text()) for each in targets)


def test_citation_package_and_extension_have_one_version_and_licence() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    extension = json.loads((ROOT / "editors/vscode/package.json").read_text("utf-8"))
    assert citation["version"] == extension["version"] == PROJECT["version"]
    assert citation["license"] == extension["license"] == PROJECT["license"]
    assert citation["url"] == extension["homepage"] == PROJECT["urls"]["Homepage"]
    assert citation["authors"] == PROJECT["authors"] == [extension["author"]]


@pytest.mark.slow
def test_hooks_find_and_mend_what_is_wrong_when_pre_commit_runs_them(tmp_path: Path) -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    # As they are, but for the environment that pre-commit would install: the commands of this one.
    local = [{**each, "language": "system", "entry": f"{BIN}/{each['entry']}"} for each in hooks]
    (tmp_path / ".pre-commit-config.yaml").write_text(yaml.safe_dump({"repos": [{"repo": "local", "hooks": local}]}))
    skill = tmp_path / "skills.skill"
    skill.write_text("use rparts\n\n## Look.\nskill Look {\n  in arm: ArmDevise\n  noplan\n}\n", "utf-8")
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    first = call(BIN / "pre-commit", "run", "--all-files", cwd=tmp_path)
    assert first.returncode == 1 and "files were modified by this hook" in first.stdout
    assert "there is no class `ArmDevise`" in first.stdout
    skill.write_text(skill.read_text("utf-8").replace("ArmDevise", "ArmDevice"), "utf-8")
    git(tmp_path, "add", "-A")
    second = call(BIN / "pre-commit", "run", "--all-files", cwd=tmp_path)
    assert second.returncode == 0, second.stdout


def test_the_manifest_of_the_hooks_is_valid() -> None:
    done = call(BIN / "pre-commit", "validate-manifest", ROOT / ".pre-commit-hooks.yaml")
    assert done.returncode == 0, done.stdout


def git(folder: Path, *arguments: str) -> None:
    program = shutil.which("git")
    assert program is not None
    done = call(program, *arguments, cwd=folder)
    assert done.returncode == 0, done.stderr
