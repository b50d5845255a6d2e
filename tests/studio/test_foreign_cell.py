"""The page with a cell of another package's back end: it cannot be drawn, and tells no truth."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, expect

from docs.installing import install, use
from foreign_backend.carts import write_carts
from server.running import serving
from studio.opening import EXPECTED_ERRORS, open_studio, start, wait_for_state


def test_a_cart_of_another_package_is_shown_and_operated(
    context: BrowserContext, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_carts(tmp_path / "carts")
    install(tmp_path / "carts", tmp_path / "site")
    use(tmp_path / "site", monkeypatch)
    problems: list[str] = []
    with serving(
        tmp_path / "served",
        options=("--backend", "cart"),
        write=lambda folder, _: write_carts(folder, "yard.ttl"),
    ) as server:
        page = context.new_page()
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda said: problems.append(said.text) if said.type == "error" else None)
        open_studio(page, server)
        expect(page.locator(".scene-empty")).to_have_text("Cells of this backend cannot be drawn.")
        start(page, "carts")
        wait_for_state(page, "succeeded", "carts")
        page.locator(".plan-step", has_text="Go").first.click()
        expect(page.get_by_role("region", name="Details")).to_contain_text("Go[by_itself]")
    assert [each for each in problems if not any(known in each for known in EXPECTED_ERRORS)] == []
