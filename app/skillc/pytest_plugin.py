"""Lets pytest collect the tests of `.skill` files: a plugin that is there where skillc is installed.

`-p no:skillc` switches it off. Nothing of skillc is imported before a file with tests is collected.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from skillc.services.testing.suite import SuiteRunner, TestResult
    from skillc_model.skills import Test

_TEST = re.compile(rb"^\s*test\s+\w+\s*\{", re.MULTILINE)


class SkillTestFailed(Exception):
    """A test of a `.skill` file did not end as it says."""

    def __init__(self, result: TestResult) -> None:
        super().__init__(result.problems[0].message)
        self.result = result


class SkillFile(pytest.File):
    """A `.skill` file with tests."""

    def collect(self) -> Iterator[SkillTest]:
        """Yield its tests; CollectError with the diagnostics of a library that has errors."""
        from skillc.errors import ServiceError
        from skillc.services.testing.suite import SuiteRunner, find_suites

        try:
            suites = find_suites([str(self.path)])
        except ServiceError as error:
            found = "\n".join(map(str, error.diagnostics)) or str(error)
            raise self.CollectError(found) from error
        for suite in suites:
            runner = SuiteRunner(suite, suite.new_coverage())
            for test in suite.tests:
                yield SkillTest.from_parent(self, name=test.name, runner=runner, test=test)


class SkillTest(pytest.Item):
    """A test of a `.skill` file."""

    def __init__(self, *, runner: SuiteRunner, test: Test, **others: Any) -> None:
        super().__init__(**others)
        self._runner, self._test = runner, test
        self.funcargs: dict[str, object] = {}  # plugins ask each item for it

    def runtest(self) -> None:
        """Run it on the world model alone; SkillTestFailed if it does not end as it says."""
        result = self._runner.run(self._test)
        if result.status == "failed":
            raise SkillTestFailed(result)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return what is wrong, with the calls that led there."""
        if not isinstance(excinfo.value, SkillTestFailed):
            return super().repr_failure(excinfo, style)
        from skillc.services.reporting.reporter import find_texts
        from skillc_dsl.rendering.full import render

        problems = excinfo.value.result.problems
        return render(problems, find_texts(problems, {}), colour=False, width=100)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return where it is."""
        return self.path, self._test.source.line - 1, self.name


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> SkillFile | None:
    """Collect a `.skill` file that has tests."""
    if file_path.suffix != ".skill" or not _TEST.search(file_path.read_bytes()):
        return None
    return SkillFile.from_parent(parent, path=file_path)
