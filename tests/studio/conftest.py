"""A browser, a server whose page it shows, and what every page has to keep: no error in the console."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from server.running import RunningServer, serving
from skillc.server.studio_page import STUDIO_FILES

playwright_api = pytest.importorskip("playwright.sync_api", reason="the tests of the studio need playwright")
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, expect, sync_playwright  # noqa: E402

from studio.opening import EXPECTED_ERRORS, open_studio, warm_up  # noqa: E402

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = (
    *("--no-sandbox", "--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
)
PATIENCE = 3
"""How many times as long as on a machine of its own something may take."""
OUT = Path(__file__).parents[2] / "out" / "studio"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """All tests here need a browser and the built page."""
    missing = "there is no Chromium" if CHROMIUM is None else "the studio is not built, `make studio` does it"
    skips = CHROMIUM is None or not (STUDIO_FILES / "index.html").exists()
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)
            if skips:
                item.add_marker(pytest.mark.skip(reason=missing))


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    expect.set_options(timeout=8_000 * PATIENCE)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        yield browser
        browser.close()


@pytest.fixture(scope="package")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving(tmp_path_factory.mktemp("studio")) as running:
        warm_up(running)
        yield running


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
    server.put_back()
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
