"""The postures of a step of a plan are drawn as ghosts in the 3-D view, before anything moves."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from refinement.hidden_post import CELL
from server.running import RunningServer, serving, wait_until
from studio.conftest import OUT, PATIENCE
from studio.opening import choose, open_studio

TASK = """
import "handling.skill"
prefix lab: <http://example.org/lab#>
use skiros

task put {
    scene "yard.ttl"
    goal  lab:Box-A contain lab:Part-A
}
"""
WATCH = """() => new PerformanceObserver((list) => {
    const drawn = list.getEntries().filter((each) => each.name === "scene drawn").at(-1);
    if (drawn !== undefined) window.drawnTriangles = drawn.detail.triangles;
}).observe({ type: "measure" })"""


def write_cell(folder: Path, takes_ms: int) -> None:
    """Write the library and the scene of a cell with an arm, a part and a box."""
    (folder / "put.skill").write_text(TASK)
    (folder / "yard.ttl").write_text(CELL.replace(", lab:Post", ""))


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving(tmp_path_factory.mktemp("put"), write=write_cell) as running:
        yield running


@pytest.fixture
def page(browser: Browser, server: RunningServer) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.set_default_timeout(8_000 * PATIENCE)
    page = context.new_page()
    open_studio(page, server)
    yield page
    context.close()


def count_triangles(page: Page) -> int:
    """Return how many triangles the last picture had."""
    return int(page.evaluate("() => window.drawnTriangles ?? 0"))


def test_the_postures_of_a_chosen_step_are_drawn_and_hidden_again(page: Page) -> None:
    page.locator(".scene-label", has_text="Part-A").wait_for()
    page.evaluate(WATCH)
    choose(page, "put")
    expect(page.locator(".preview-step")).to_have_count(2)
    button = page.get_by_role("button", name="Show the postures of step 1")
    page.get_by_role("button", name="Side").first.click()
    before = wait_until(lambda: count_triangles(page), bool)
    button.click()
    with_ghosts = wait_until(lambda: count_triangles(page), lambda count: count > before)
    page.screenshot(path=OUT / "plan-postures.png")
    page.get_by_role("button", name="Hide the postures of step 1").click()
    wait_until(lambda: count_triangles(page), lambda count: count == before)
    page.get_by_role("button", name="Show the postures of step 2").click()
    expect(page.get_by_role("button", name="Hide the postures of step 2")).to_have_attribute("aria-pressed", "true")
    wait_until(lambda: count_triangles(page), lambda count: count > before)
    assert with_ghosts > before
    page.get_by_role("button", name="all tasks").click()
    wait_until(lambda: count_triangles(page), lambda count: count == before)
