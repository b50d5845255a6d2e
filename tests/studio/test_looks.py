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


def test_nothing_overflows_1280_by_800(page: Page) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    assert _overflow(page) == (0, 0)
    for panel in "12345":
        page.keyboard.press(panel)
        page.keyboard.press("m")
        assert _overflow(page) == (0, 0)
        page.keyboard.press("m")


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
