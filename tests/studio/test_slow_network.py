"""The page over a slow network: it says that it is loaded, can be used, and misses nothing."""

from __future__ import annotations

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from server.running import RunningServer
from studio.opening import (
    FINISHED,
    make_code,
    origin_of,
    press_start,
    put_back,
    start,
    wait_for_last_event,
    wait_for_state,
)

pytestmark = pytest.mark.early

SLOW = {"offline": False, "latency": 400, "downloadThroughput": 50_000, "uploadThroughput": 50_000}
"""Latency in ms, and bytes/s."""


def _wait_for_all_events(page: Page, server: RunningServer) -> None:
    """Wait until the page has all events of the last operation."""
    last = wait_for_last_event(page)
    operation = server.client.get("/cells/yard/operations").json()[0]["id"]
    events = server.client.get(f"/operations/{operation}/events", params={"limit": 1000}).json()
    assert last == len(events) > 20


def test_a_slow_network_delays_and_loses_nothing(context: BrowserContext, server: RunningServer) -> None:
    put_back(server)
    server.client.put("/cells/yard/pace", json={"factor": 0.1})
    page = context.new_page()
    throttle = context.new_cdp_session(page)
    throttle.send("Network.enable")
    throttle.send("Network.emulateNetworkConditions", SLOW)
    page.goto(f"{origin_of(server)}/#code={make_code(server)}", wait_until="commit")
    expect(page.get_by_text("skillc studio is loaded")).to_be_visible()
    expect(page.get_by_text("The 3-D view is loaded")).to_be_visible()
    start(page, "carry_all")
    wait_for_state(page, "running")
    expect(page.locator(".tree-row.is-running").first).to_be_visible()
    page.get_by_role("button", name="Stop", exact=True).click()
    wait_for_state(page, "stopped")
    _wait_for_all_events(page, server)
    server.client.put("/cells/yard/pace", json={"factor": None})
    page.get_by_role("button", name="Run something else").click()
    page.get_by_role("list", name="Tasks").get_by_role("button", name="carry_all").click()
    press_start(page)
    wait_for_state(page, FINISHED)
    _wait_for_all_events(page, server)
    expect(page.locator(".plan-step .is-good:visible").first).to_be_visible()
    expect(page.get_by_text("The 3-D view is loaded")).to_be_hidden()
    page.keyboard.press("s")
    expect(page.get_by_label("Source of confirm.skill")).to_be_visible()
