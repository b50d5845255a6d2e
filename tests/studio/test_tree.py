"""A tree of 3,000 nodes: only what is in sight is in the page, and it is found, folded and followed."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import BrowserContext, expect

from server.running import serving
from studio.opening import choose, open_studio, wait_for_state

WAITS = 3000


def test_a_tree_of_3000_nodes(context: BrowserContext, tmp_path: Path) -> None:
    steps = "\n".join(f"        wait {1 + number % 2} ms" for number in range(WAITS))
    many = f'task many {{\n    scene "yard.ttl"\n    do seq {{\n{steps}\n    }}\n}}\n'
    (tmp_path / "many.skill").write_text(many, encoding="utf-8")
    with serving(tmp_path) as server:
        page = context.new_page()
        open_studio(page, server)
        choose(page, "many")
        page.get_by_role("button", name="Start", exact=True).click()  # the check of the whole plan takes longer
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
