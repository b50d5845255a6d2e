"""A browser, a server whose page it shows, and what every page has to keep: no error in the console."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from running_cells.asking import write_question
from server.running import RunningServer, serving
from skillc.server.studio_page import STUDIO_FILES

playwright_api = pytest.importorskip("playwright.sync_api", reason="the tests of the studio need playwright")
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, expect, sync_playwright  # noqa: E402

from studio.chromium import CHROMIUM, launch  # noqa: E402
from studio.opening import EXPECTED_ERRORS, open_studio, put_back, warm_up  # noqa: E402
from waiting import LONG_S  # noqa: E402

PATIENCE = 10
"""How many times as long as on a machine of its own something may take."""
WAITS = 3000
"""How many steps the task `many` of the fragile server has."""
OUT = Path(__file__).parents[2] / "out" / "studio"


REST = """# Something that goes on until it is stopped.

task rest {
    scene "yard.ttl"
    do seq { wait 600 s }
}
"""


def write_many() -> str:
    """Return a task of WAITS steps, none of which takes long."""
    steps = "\n".join(f"        wait {1 + number % 2} ms" for number in range(WAITS))
    return f'task many {{\n    scene "yard.ttl"\n    do seq {{\n{steps}\n    }}\n}}\n'


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """All tests here need a browser and the built page."""
    missing = "there is no Chromium" if CHROMIUM is None else "the studio is not built, `make studio` does it"
    skips = CHROMIUM is None or not (STUDIO_FILES / "index.html").exists()
    for item in items:
        if item.nodeid.startswith("tests/studio/"):
            item.add_marker(pytest.mark.browser)
            if skips:
                item.add_marker(pytest.mark.skip(reason=missing))


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    expect.set_options(timeout=8_000 * PATIENCE)
    with sync_playwright() as playwright:
        browser = launch(playwright)
        yield browser
        browser.close()


@pytest.fixture(scope="package")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server of a yard whose library also asks a question, and has a task that goes on until it is stopped."""
    folder = tmp_path_factory.mktemp("studio")
    write_question(folder)
    (folder / "rest.skill").write_text(REST, encoding="utf-8")
    with serving(folder) as running:
        warm_up(running)
        yield running


@pytest.fixture(scope="package")
def fragile(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server to break, with a task of many steps; what is killed has to be started again, and be its `process`."""
    folder = tmp_path_factory.mktemp("fragile")
    (folder / "many.skill").write_text(write_many(), encoding="utf-8")
    with serving(folder, takes_ms=2000) as running:
        warm_up(running)
        try:
            yield running
        finally:
            running.process.terminate()
            running.process.wait(LONG_S)


@pytest.fixture
def context(browser: Browser, request: pytest.FixtureRequest) -> Iterator[BrowserContext]:
    """A browser of its own for a test, with the marker `looks` in dark or another size."""
    marker = request.node.get_closest_marker("looks")
    looks = {"viewport": {"width": 1280, "height": 800}, **(marker.kwargs if marker else {})}
    context = browser.new_context(**looks)
    context.set_default_timeout(8_000 * PATIENCE)
    yield context
    context.close()


def describe(message: ConsoleMessage) -> str:
    """Return what a page has written to the console, and what it is about."""
    return f"{message.text} {message.location['url']}"


@pytest.fixture
def page(context: BrowserContext, server: RunningServer, request: pytest.FixtureRequest) -> Iterator[Page]:
    """The page, logged in, with all crates at the start."""
    put_back(server)
    server.client.put("/cells/yard/pace", json={"factor": None})
    page = context.new_page()
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.on("console", lambda message: problems.append(describe(message)) if message.type == "error" else None)
    open_studio(page, server)
    yield page
    OUT.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=OUT / f"{request.node.name}.png")
    assert [each for each in problems if not any(known in each for known in EXPECTED_ERRORS)] == []
