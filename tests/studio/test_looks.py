"""Every view in light and dark, checked by axe, with pictures for people to look at; and the plan of a large screen."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from studio.conftest import OUT
from studio.opening import FINISHED, start, wait_for_state

AXE = Path(__file__).parents[2] / "studio" / "node_modules" / "axe-core" / "axe.min.js"
VIEWS = {
    "why": ("w", ".details-section"),
    "world": ("f", ".world tbody tr"),
    "source": ("s", ".source .cm-line"),
    "events": ("e", ".event"),
    "runs": ("h", ".run-item"),
    "choose": ("r", ".preview-step, [aria-label=Tasks] button"),
}
"""The key of each view, and what is there once it is."""


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_all_views_pass_axe(page: Page, scheme: str) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    page.locator(".plan-step", has_text="Unload").first.click()
    page.evaluate(AXE.read_text(encoding="utf-8"))
    for name, (key, content) in VIEWS.items():
        page.keyboard.press("Escape")
        page.keyboard.press("2")
        page.keyboard.press(key)
        page.locator(content).first.wait_for()
        page.screenshot(path=OUT / f"{name}-{scheme}.png")
        assert _violations(page) == [], name
    page.keyboard.press("2")
    page.keyboard.press("?")
    expect(page.get_by_role("dialog")).to_be_visible()
    page.screenshot(path=OUT / f"help-{scheme}.png")
    assert _violations(page) == [], "help"


@pytest.mark.looks(viewport={"width": 3840, "height": 2160})
def test_nothing_overflows_a_4k_screen(page: Page) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    assert _overflow(page) == (0, 0)
    assert page.locator(".scene-view canvas").evaluate("each => each.clientWidth") > 1500
    page.keyboard.press("w")
    lines = page.locator(".details > *").evaluate_all("all => all.map((each) => each.clientWidth)")
    assert 0 < max(lines) < 800, "lines are not too long to be read"
    _check_graph(page)


def test_the_run_panel_is_wider_in_a_wide_window_and_lines_between_panels_follow_the_pointer(page: Page) -> None:
    panel = page.locator(".column-left")
    widths = {}
    for width in (1280, 1600, 1920, 2560):
        page.set_viewport_size({"width": width, "height": 1080})
        widths[width] = panel.evaluate("each => each.clientWidth")
    assert widths == {1280: 300, 1600: 380, 1920: 420, 2560: 420}
    for name in ("Width of the tree", "Width of the run panel"):
        line = page.get_by_role("separator", name=name)
        before = line.bounding_box()
        assert before is not None
        page.mouse.move(before["x"] + 3, 500)
        page.mouse.down()
        page.mouse.move(before["x"] + 53, 500)
        page.mouse.up()
        after = line.bounding_box()
        assert after is not None
        assert after["x"] - before["x"] == pytest.approx(50, abs=1), name


def _check_graph(page: Page) -> None:
    """Show the graph of the world, and check that its text is as large as that beside it, and all of it in sight."""
    page.keyboard.press("f")
    page.get_by_label("What to show").select_option("graph")
    nodes = page.locator(".graph-node rect")
    nodes.nth(1).wait_for()
    heights = nodes.evaluate_all("all => all.map((each) => Math.round(each.getBoundingClientRect().height))")
    assert set(heights) <= {22, 23, 24}
    seen = page.locator("[data-panel=details]").bounding_box()
    drawn = page.locator(".world-graph svg").bounding_box()
    assert seen is not None and drawn is not None
    assert drawn["x"] >= seen["x"] and drawn["x"] + drawn["width"] <= seen["x"] + seen["width"]


def test_nothing_overflows_1280_by_800(page: Page) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    assert _overflow(page) == (0, 0)
    for panel in "12345":
        page.keyboard.press(panel)
        page.keyboard.press("m")
        assert _overflow(page) == (0, 0)
        page.keyboard.press("m")
    _check_graph(page)


def _overflow(page: Page) -> tuple[int, int]:
    """Return by how many pixels the page is wider and higher than its window."""
    found = page.evaluate(
        "() => { const e = document.documentElement;"
        "const right = Math.max(...[...document.querySelectorAll('.topbar > *, .panel')]"
        ".map((each) => each.getBoundingClientRect().right));"
        "return [Math.max(0, Math.ceil(right) - innerWidth), e.scrollHeight - innerHeight]; }"
    )
    return (found[0], found[1])


def _violations(page: Page) -> list[str]:
    found = page.evaluate("async () => (await axe.run()).violations")
    return [f"{each['id']}: {node['html'][:300]}" for each in found for node in each["nodes"]]
