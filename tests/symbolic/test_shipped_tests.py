"""The tests of the shipped libraries and of each template pass, and pytest collects them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from skillc.services.library.files import SHIPPED
from skillc.services.scaffolding.new_library import create_library
from skillc.services.scaffolding.project_templates import TEMPLATES
from skillc.services.testing import suite
from waiting import LONG_S

PLUGIN = ("-p", "no:skillc", "-p", "skillc.pytest_plugin", "-p", "no:cacheprovider")
"""The plugin by the name of its module, so that it does not depend on how skillc is installed."""


def run_all(folder: Path) -> list[suite.TestResult]:
    """Run all tests of a library."""
    found = suite.find_suites([str(folder)])
    return [result for each in found for result in suite.run_suite(each, each.new_coverage())]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["std", "wiping", "contact", "sorting"])
def test_those_of_a_shipped_library_pass(name: str) -> None:
    results = run_all(SHIPPED / name)
    assert len(results) >= 3
    assert [(each.name, each.problems) for each in results if each.status != "passed"] == []


@pytest.mark.slow
@pytest.mark.parametrize("template", [each.name for each in TEMPLATES])
def test_those_of_a_template_pass(template: str, tmp_path: Path) -> None:
    create_library(tmp_path / "made", template)
    results = run_all(tmp_path / "made")
    assert len(results) >= 2
    assert [(each.name, each.problems) for each in results if each.status != "passed"] == []


def collect(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run pytest in a folder, which knows nothing of this one."""
    (folder / "pytest.ini").write_text("[pytest]\n")
    command = [sys.executable, "-m", "pytest", "-q", *PLUGIN, *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=LONG_S)


@pytest.mark.slow
def test_pytest_collects_them(tmp_path: Path) -> None:
    folder = tmp_path / "made"
    create_library(folder, "blank")
    (folder / "terms.skill").write_text("use skiros\n\nclass Rag < Product\n")
    passed = collect(folder, "--ignore", "tests")
    assert passed.returncode == 0 and "2 passed" in passed.stdout, passed.stdout
    one = collect(folder, "tests.skill", "-k", "fault")
    assert "1 passed, 1 deselected" in one.stdout
    text = (folder / "tests.skill").read_text()
    (folder / "tests.skill").write_text(text.replace("isHome == true", "isHome == false"))
    failed = collect(folder, "tests.skill")
    assert failed.returncode == 1 and "1 failed, 1 passed" in failed.stdout
    assert "error[test-failed]: `lab:Arm-1.isHome == false` does not hold at the end" in failed.stdout
    assert "Made[joints] succeeded" in failed.stdout and "tests.skill::the_arm_is_home_in_the_end" in failed.stdout
    (folder / "tests.skill").write_text(text.replace("lab:Arm-1.isHome", "lab:Arm-1.isHoem"))
    broken = collect(folder, "tests.skill")
    assert broken.returncode == 2 and "there is no property `isHoem`" in broken.stdout
