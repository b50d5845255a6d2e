"""Checks what a page shows with axe, and keeps a picture of it for people to look at."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page

from studio.conftest import OUT

AXE = Path(__file__).parents[2] / "studio" / "node_modules" / "axe-core" / "axe.min.js"


def check_axe(page: Page, name: str) -> None:
    """Keep a picture of the page under a name; AssertionError with what axe finds in it."""
    if not page.evaluate("typeof axe !== 'undefined'"):
        page.evaluate(AXE.read_text(encoding="utf-8"))
    OUT.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=OUT / f"{name}.png")
    found = page.evaluate("async () => (await axe.run()).violations")
    problems = [f"{each['id']}: {node['html'][:300]}" for each in found for node in each["nodes"]]
    assert not problems, (name, problems)
