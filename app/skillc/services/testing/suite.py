"""Finds the tests that are asked for, and runs them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Literal, TypeAlias

import msgspec

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc.services.library.libraries_below import find_libraries
from skillc.services.planning.planning import prepare_planners
from skillc.services.reporting.files import inspect_path
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import load_world
from skillc.services.tasks.loading import find_scene_of
from skillc.services.testing.coverage import Coverage
from skillc.services.testing.failures import FAILED, find_failures
from skillc.services.testing.running import TestRun, run_test
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary, Test
from skillc_runtime.planning.schedule import Planners
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.world_state import WorldState

TestStatus: TypeAlias = Literal["passed", "failed"]


class TestResult(msgspec.Struct, frozen=True, kw_only=True):
    """How a test went; `problems` are empty if it passed. Its times are in s, of the cell and of the wall clock."""

    library: str
    name: str
    file: str
    line: int
    doc: str = ""
    status: TestStatus = "passed"
    cell_s: float = 0.0
    wall_s: float = 0.0
    problems: tuple[Diagnostic, ...] = ()


class TestSuite(msgspec.Struct, frozen=True):
    """The tests of one library that are asked for, in the order of its files, and the library as they run it."""

    files: LibraryFiles
    library: SkillLibrary
    tests: tuple[Test, ...]

    def new_coverage(self) -> Coverage:
        """Return what tests cover of the library's own files, before any."""
        return Coverage.of(self.library, (each.path for each in self.files.sources))


def find_suites(wanted: Sequence[str]) -> list[TestSuite]:
    """Find the tests in libraries, files or folders that are named, or those here of names, which may have `*`.

    RequestError if there are none, or for a name that no test has; DiagnosticsError for a library with errors.
    """
    paths = [Path(each) for each in wanted if _is_place(each)]
    names = [each for each in wanted if not _is_place(each)]
    suites = [read_suite(files, path) for path in paths or [Path()] for files in _libraries_at(path)]
    known = [test.name for suite in suites for test in suite.tests]
    for name in names:
        if not any(fnmatchcase(each, name) for each in known):
            raise RequestError(f"there is no test `{name}`; {did_you_mean(name, known) or _list(known)}")
    if names:
        suites = [_select(each, names) for each in suites]
    found = [each for each in suites if each.tests]
    if not found:
        where = ", ".join(map(str, paths)) or "here"
        raise RequestError(f"there are no tests {where}: write `test NAME {{ .. }}` in a `.skill` file")
    return found


def run_suite(
    suite: TestSuite, coverage: Coverage, tell: Callable[[TestResult], None] = lambda result: None
) -> list[TestResult]:
    """Run the tests of a suite one after the other; report each at its end, and add its coverage."""
    results, runner = [], SuiteRunner(suite, coverage)
    for test in suite.tests:
        results.append(runner.run(test))
        tell(results[-1])
    return results


class SuiteRunner:
    """Runs tests of a suite in any order; each scene is read once."""

    def __init__(self, suite: TestSuite, coverage: Coverage) -> None:
        self._suite, self._coverage = suite, coverage
        self._planners: Planners = prepare_planners(True)
        self._scenes: dict[Path, WorldState] = {}

    def run(self, test: Test) -> TestResult:
        """Run a test, and add what it covers."""
        files = self._suite.files
        run = None
        try:
            run = self._run(test)
            problems = find_failures(test, run, files.display_path)
        except DiagnosticsError as error:
            problems = tuple(error.diagnostics)
        except RequestError as error:
            problems = (self._refuse(test, str(error)),)
        except WorldError as error:
            problems = (self._refuse(test, f"what `{test.name}` starts with contradicts the scene: {error}"),)
        return _make_result(self._suite, test, run, problems)

    def _run(self, test: Test) -> TestRun:
        file = find_scene_of(test, self._suite.files)
        library = self._suite.library
        if file not in self._scenes:
            self._scenes[file] = load_world(file, library.vocabulary, SilentReporter())
        return run_test(test, library, self._scenes[file], file, self._planners, self._coverage)

    def _refuse(self, test: Test, why: str) -> Diagnostic:
        place = test.source
        path = self._suite.files.display_path(place.path)
        return Diagnostic(FAILED, Span(path, place.line, place.column, place.line, place.column + 1), why)


def _make_result(suite: TestSuite, test: Test, run: TestRun | None, problems: tuple[Diagnostic, ...]) -> TestResult:
    return TestResult(
        library=suite.library.name,
        name=test.name,
        file=suite.files.display_path(test.source.path),
        line=test.source.line,
        doc=test.doc,
        status="failed" if any(each.severity == "error" for each in problems) else "passed",
        cell_s=run.cell_s if run is not None else 0.0,
        wall_s=run.wall_s if run is not None else 0.0,
        problems=problems,
    )


def _is_place(wanted: str) -> bool:
    """Whether this is a file, a folder or the name of a shipped library, rather than the name of a test."""
    return inspect_path(Path(wanted)).kind != "missing" or wanted.endswith(".skill") or (SHIPPED / wanted).is_dir()


def _libraries_at(path: Path) -> Iterator[LibraryFiles]:
    if inspect_path(path).kind == "folder":
        yield from find_libraries(path)
    else:
        yield find_library(path.parent) if path.suffix == ".skill" and path.exists() else find_library(path)


def read_suite(files: LibraryFiles, path: Path) -> TestSuite:
    """Return the tests of a library, or of its file that was named."""
    library = act_as_declared(compile_valid(files))
    own = {each.path for each in files.sources}
    if path.suffix == ".skill":
        own = {each for each in own if files.places[each].resolve() == path.resolve()}
    tests = (each for each in library.tests.values() if each.source.path in own)
    return TestSuite(files, library, tuple(sorted(tests, key=lambda each: each.source)))


def _select(suite: TestSuite, names: Sequence[str]) -> TestSuite:
    kept = tuple(each for each in suite.tests if any(fnmatchcase(each.name, name) for name in names))
    return msgspec.structs.replace(suite, tests=kept)


def _list(known: Sequence[str]) -> str:
    return f"there are {', '.join(known)}" if known else "there are none"
