"""What holds for all tests."""

import gc
import os
import re
import signal
import sys
from collections.abc import Generator, Iterator, Set
from contextlib import suppress
from functools import cache
from itertools import chain, combinations
from pathlib import Path

import pytest
from _pytest.mark.expression import Expression
from hypothesis import HealthCheck, settings

from skillc_dsl.cache import cache_folder
from skillc_dsl.garbage import exempt_for_ever, gc_disabled
from waiting import LONG_S

# No test depends on how fast the machine is. Each run tries other examples, so that few of each property are enough.
settings.register_profile("skillc", deadline=None, max_examples=30, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("fixed", settings.get_profile("skillc"), derandomize=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "skillc"))

# Folders whose tests run whole cells and servers in processes of their own.
SLOW_FOLDERS = ("tests/operating/", "tests/running_cells/", "tests/server/")
MARKED_FOLDERS = {**dict.fromkeys(SLOW_FOLDERS, "slow"), "tests/studio/": "browser", "tests/robots/ros2/": "robot"}

# Limits of wall time of planning and of looks in space that nobody has set: on a busy machine they end what takes a few
# seconds on a quiet one.
LIMITS = (
    "skillc.services.run.running.DEADLINE_S",
    "skillc.services.space.verdicts.LIMIT_S",
    "skillc_runtime.execution.task_planning.DEADLINE_S",
    "skillc_runtime.execution.refinement.run_planning.LOOK_S",
    "skillc_runtime.planning.makespan.minimise.DEADLINE_S",
    "skillc_runtime.planning.solve.DEADLINE_S",
)

# Tests of, or with, what only Unix has.
if sys.platform == "win32":
    collect_ignore = ["world/test_room.py", "fuzz", "store", "operating", "running_cells", "server"]
    collect_ignore += ["killed_servers", "random_requests"]


def pytest_configure() -> None:
    """Let output and caches depend on tests alone, and processes that tests start listen to Ctrl-C and SIGHUP.

    In the background, where tests may run, they would not.
    """
    for name in ("CI", "COLUMNS", "FORCE_COLOR", "NO_COLOR", "SKILLC_CACHE", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        os.environ.pop(name, None)
    os.environ["TERM"] = "xterm"
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if sys.platform != "win32":
        signal.signal(signal.SIGHUP, signal.SIG_DFL)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out folders and files of whose tests `-m` selects none, by their marks: importing all takes seconds."""
    if not config.option.markexpr or not (collection_path.is_dir() or collection_path.name.startswith("test_")):
        return None
    place = f"{collection_path.relative_to(config.rootpath).as_posix()}/"
    certain = {mark for folder, mark in MARKED_FOLDERS.items() if place.startswith(folder)}
    possible = set(config.option.markexpr.replace("(", " ").replace(")", " ").split())
    if collection_path.is_file():
        certain |= set(re.findall(r"^pytestmark = pytest\.mark\.(\w+)$", read(collection_path), re.MULTILINE))
        possible &= marks_near(collection_path)
    return True if not any(selects(config, {*certain, *more}) for more in subsets(possible - certain)) else None


def marks_near(file: Path) -> set[str]:
    """Return the marks that a file of tests names, or a module of ours from which it imports parameters."""
    modules = re.findall(r"^from ([\w.]+) import", read(file), re.MULTILINE)
    folders = (Path(__file__).parent, file.parent)
    ours = (folder / f"{module.replace('.', '/')}.py" for module in modules for folder in folders)
    return {mark for each in (file, *filter(Path.exists, ours)) for mark in re.findall(r"\bmark\.(\w+)", read(each))}


@cache
def read(file: Path) -> str:
    """Return the text of a file."""
    return file.read_text("utf-8")


def selects(config: pytest.Config, marks: Set[str]) -> bool:
    """Whether `-m` selects a test with these marks."""
    return Expression.compile(config.option.markexpr).evaluate(lambda name, **_: name in marks)


def subsets(names: Set[str]) -> Iterator[tuple[str, ...]]:
    """Yield all sets of some names."""
    return chain.from_iterable(combinations(sorted(names), size) for size in range(len(names) + 1))


@pytest.hookimpl(wrapper=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> Generator[None, object, object]:
    """Mark the tests of slow folders as `slow`; of those that are selected, begin with the ones marked `early`."""
    for item in items:
        if item.nodeid.startswith(SLOW_FOLDERS):
            item.add_marker("slow")
    done = yield
    items[:] = begin_with_early(items, count_parts(config))
    return done


def count_parts(config: pytest.Config) -> int:
    """In how many equal parts the tests are given out: one a process, but with `--dist loadscope` file by file."""
    is_by_file = "loadscope" in getattr(config, "workerinput", {"mainargv": ()})["mainargv"]
    return 1 if is_by_file else int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", 1))


def begin_with_early(items: list[pytest.Item], parts: int) -> list[pytest.Item]:
    """Order tests so that each of as many equal parts begins with its share of early ones."""
    early = [item for item in items if item.get_closest_marker("early")]
    others = [item for item in items if not item.get_closest_marker("early")]
    ordered: list[pytest.Item] = []
    for part in range(parts):
        share = early[part::parts]
        size = max(0, (len(items) - len(ordered)) // (parts - part) - len(share))
        ordered += (*share, *others[:size])
        del others[:size]
    return ordered


def pytest_runtest_teardown(item: pytest.Item) -> None:
    """Fail a test that has limited the memory of this process: in later ones, threads may never start."""
    if sys.platform != "win32":
        import resource

        limit, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
        assert limit == hard, f"{item.nodeid} limited the memory of the process of tests"


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Do not look for garbage while tests are imported: there is none, and it takes a fifth of the time."""
    with gc_disabled():
        return (yield)


def pytest_collection_finish() -> None:
    """Spare what was imported for the tests, which stays to the end, from being looked through for garbage.

    The rest is looked through less often than usual, which took a fortieth of the time.
    """
    exempt_for_ever()
    gc.set_threshold(20_000, 20, 20)


@pytest.fixture(autouse=True, scope="session")
def long_limits() -> Iterator[None]:
    """Let what is planned and looked at in this process take as long as a busy machine needs."""
    with pytest.MonkeyPatch.context() as patch:
        for limit in LIMITS:
            with suppress(ImportError):  # the compiler alone is tested without what plans
                patch.setattr(limit, LONG_S)
        yield


@pytest.fixture
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache folder of the test's own, empty but for machine code: to compile all of it takes 20 s."""
    users, own = cache_folder(), tmp_path / "cache" / "skillc"
    assert users is not None
    for each in (users / "machine-code", own):
        each.mkdir(parents=True, exist_ok=True)
    (own / "machine-code").symlink_to(users / "machine-code", target_is_directory=True)
    monkeypatch.setenv("XDG_CACHE_HOME", str(own.parent))
    return own
