"""The signals of an arm: no plot is given the columns of other lines than its own."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Browser, expect

from server.running import serving_bench
from studio.conftest import PATIENCE
from studio.opening import open_studio


def test_lines_come_and_go(browser: Browser, tmp_path: Path) -> None:
    with serving_bench(tmp_path) as bench, browser.new_context() as context:
        context.set_default_timeout(8_000 * PATIENCE)
        page = context.new_page()
        problems: list[str] = []
        page.on("pageerror", lambda error: problems.append(str(error)))
        open_studio(page, bench)
        page.get_by_role("combobox", name="Cell", exact=True).select_option("bench")
        names = page.get_by_role("region", name="Signals and plan").locator(".u-legend .u-label")
        kind = page.get_by_label("Which kind of signal")
        for chosen in ("speed", "all signals", "commanded speed"):
            kind.select_option(chosen)
            expect(names).to_have_count(3 if chosen == "all signals" else 2)
        assert problems == []
