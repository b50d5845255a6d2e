"""Trials: a series is begun, its distributions are shown, and its worst case is one click from its replay."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from server.running import RunningServer
from studio.accessibility import check_axe


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_the_worst_case_of_a_series_is_one_click_from_its_replay(
    page: Page, server: RunningServer, scheme: str
) -> None:
    page.keyboard.press("h")
    page.get_by_role("tab", name="Jobs").click()
    page.get_by_role("button", name="New trials").click()
    page.get_by_label("Task", exact=True).select_option("carry")
    page.get_by_role("combobox", name="crate").fill("lab:crate-1")
    page.get_by_role("combobox", name="to", exact=True).fill("lab:Goal")
    page.get_by_role("spinbutton", name="Trials").fill("5")
    check_axe(page, f"trials-new-{scheme}")
    page.get_by_role("button", name="Begin").click()
    series = page.locator(".series", has_text="Trials").first
    series.wait_for()
    begun = series.get_attribute("title") or ""
    server.wait_for_job(begun)
    expect(series).to_contain_text("5 passed")
    series.click()
    shown = page.get_by_role("main", name="Trials of carry")
    shown.locator(".distribution").first.wait_for()
    told = server.find_outcome(begun)["series"]
    expect(shown.locator(".distribution")).to_have_count(len(told["spreads"]))
    expect(shown.locator(".distribution").first.locator(".dot")).to_have_count(5)
    check_axe(page, f"trials-{scheme}")
    slowest = told["spreads"][0]
    worst = slowest["seeds"][slowest["values"].index(slowest["greatest"])]
    shown.get_by_role("button", name="Replay the worst").first.click()
    expect(page.locator(".topbar .operation")).to_contain_text(f"carry, seed {worst}", timeout=120_000)
    expect(page.locator(".tree-row[aria-level='1'].is-success")).to_have_count(2)
    page.get_by_role("button", name="Back to the cell").click()
    series.click()
    shown.get_by_role("button", name="Forget").click()
    shown.get_by_role("button", name="Forget them").click()
    expect(shown).to_be_hidden()
    assert server.client.get(f"/jobs/{begun}").status_code == 404


def test_trials_that_cannot_be_run_are_refused_where_they_are_written(page: Page) -> None:
    page.keyboard.press("h")
    page.get_by_role("tab", name="Jobs").click()
    page.get_by_role("button", name="New trials").click()
    page.get_by_label("Task", exact=True).select_option("carry")
    expect(page.get_by_role("button", name="Begin")).to_be_disabled()
    page.get_by_role("combobox", name="crate").fill("lab:no-such-crate")
    page.get_by_role("combobox", name="to", exact=True).fill("lab:Goal")
    page.get_by_role("button", name="Begin").click()
    expect(page.get_by_role("alert").filter(has_text="no-such-crate")).to_be_visible()
    expect(page.get_by_role("combobox", name="crate")).to_have_value("lab:no-such-crate")
