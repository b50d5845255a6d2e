"""A tree of 3,000 nodes: only what is in sight is in the page, and it is found, folded and followed."""

from __future__ import annotations

from playwright.sync_api import BrowserContext, expect

from server.running import RunningServer
from studio.conftest import WAITS
from studio.opening import choose, open_studio, press_start, wait_for_state


def test_a_tree_of_3000_nodes(context: BrowserContext, fragile: RunningServer) -> None:
    fragile.client.put("/cells/yard/pace", json={"factor": None})
    page = context.new_page()
    open_studio(page, fragile)
    choose(page, "many")
    press_start(page)
    wait_for_state(page, "succeeded", "many")
    rows = page.locator(".tree-row")
    expect(rows.first).to_have_attribute("aria-setsize", str(WAITS))
    assert rows.count() < 60
    page.keyboard.press("2")
    page.keyboard.press("End")
    last = page.locator(".tree-row[aria-selected=true]")
    expect(last).to_have_attribute("aria-posinset", str(WAITS))
    expect(last).to_be_in_viewport()
    page.keyboard.press("Home")
    expect(page.locator(".tree-row[aria-selected=true]")).to_have_attribute("aria-posinset", "1")
    page.get_by_label("Filter the tree").fill("nothing")
    expect(page.get_by_text("No node has")).to_be_visible()
