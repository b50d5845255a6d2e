"""The 3-D view: where from, what is measured, and the two tools that move a thing, in reality or in the world model."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from server.running import RunningServer, serving_bench
from studio.conftest import OUT, PATIENCE
from studio.opening import open_studio

PART = "http://example.org/lab#Part-A"


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving_bench(tmp_path_factory.mktemp("bench")) as running:
        yield running


@pytest.fixture(scope="module")
def scene(browser: Browser, bench: RunningServer) -> Iterator[Page]:
    """A page with the 3-D view of the bench, enlarged."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.set_default_timeout(8_000 * PATIENCE)
    page = context.new_page()
    open_studio(page, bench)
    page.get_by_role("combobox", name="Cell", exact=True).select_option("bench")
    page.get_by_role("button", name="Enlarge 3-D").click()
    _label(page, "name", "Part-A").wait_for()
    yield page
    page.screenshot(path=OUT / "scene.png")
    context.close()


def _label(page: Page, kind: str, text: str) -> Locator:
    return page.locator(f".scene-label[data-kind={kind}]", has_text=text)


def _tool(page: Page, name: str) -> Locator:
    return page.get_by_role("group", name="Mouse").get_by_role("button", name=name)


def _choose_part(page: Page, tool: str) -> Locator:
    """Select the part in the facts, and choose a tool for it; return the form that moves it."""
    page.get_by_role("button", name="Show all panels again").click()
    page.keyboard.press("f")
    page.get_by_label("Search in the facts").fill("Part-A")
    page.locator(".world tbody").get_by_role("button", name="lab:Part-A", exact=True).first.click()
    page.get_by_role("button", name="Enlarge 3-D").click()
    _tool(page, tool).click()
    return page.get_by_role("form")


def test_presets_look_from_other_places(scene: Page) -> None:
    part = _label(scene, "name", "Part-A")
    seen = set[str]()
    for preset in ("Front", "Side", "Top", "Fit"):
        scene.get_by_role("group", name="View").get_by_role("button", name=preset).click()
        expect(part).not_to_have_attribute("style", re.compile("|".join(map(re.escape, seen)) or "nothing"))
        _wait_until_still(scene)
        seen.add(part.get_attribute("style") or "")
    assert len(seen) == 4


def _wait_until_still(page: Page) -> None:
    """Wait until labels are where they were in the frame before, three times."""
    page.evaluate(
        """() => new Promise((resolve) => {
            let [before, same] = ["", 0];
            const look = () => {
                const now = [...document.querySelectorAll(".scene-label")].map((each) => each.style.cssText).join();
                same = now === before ? same + 1 : 0;
                before = now;
                if (same === 3) resolve();
                else requestAnimationFrame(look);
            };
            look();
        })"""
    )


def test_the_distance_of_two_points(scene: Page) -> None:
    _tool(scene, "Measure").click()
    box = scene.locator(".scene-view canvas").bounding_box()
    assert box is not None
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    scene.mouse.click(*middle)
    expect(_label(scene, "measure", "to …")).to_be_visible()
    scene.mouse.click(middle[0] + 60, middle[1] + 40)
    expect(_label(scene, "measure", " m ")).to_have_text(re.compile(r"\d\.\d{3} m   x -?\d"))
    _tool(scene, "Select").click()
    expect(scene.locator(".scene-label[data-kind=measure]")).to_have_count(0)


def test_a_disturbance_and_a_correction_are_two_tools(scene: Page, bench: RunningServer) -> None:
    before = bench.client.get("/cells/bench/poses").json()[PART]
    form = _choose_part(scene, "Move in reality")
    expect(form).to_contain_text("The robot is not told")
    expect(form.get_by_role("button", name="Move it really")).to_be_disabled()
    form.get_by_label("x").fill("0.05")
    form.get_by_label("x").press("Tab")
    form.get_by_role("button", name="Move it really").click()
    expect(_label(scene, "believed", "Part-A is believed 50 mm away")).to_be_visible()
    assert bench.client.get("/cells/bench/poses").json()[PART] == before, "the world model has not changed"
    form = _choose_part(scene, "Correct belief")
    expect(form).to_contain_text("Nothing moves")
    form.get_by_label("x").fill("0.05")
    form.get_by_label("x").press("Tab")
    form.get_by_label("Why").fill("I see it there")
    form.get_by_role("button", name="Change belief").click()
    expect(scene.locator(".scene-label[data-kind=believed]")).to_have_count(0)
    after = bench.client.get("/cells/bench/poses").json()[PART]
    assert np.allclose(after[:3], np.add(before[:3], (0.05, 0.0, 0.0)), atol=1e-3)
    written = bench.client.get("/cells/bench/world/history", params={"limit": 1}).json()[0]
    assert "I see it there" in written["origin"]
