"""Two pages, one with the lease: the other one says so before anything is tried, watches, and may stop."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from server.running import RunningServer
from studio.accessibility import check_axe
from studio.opening import choose, origin_of, start, wait_for_state


def log_in(page: Page, server: RunningServer, token: str) -> None:
    page.goto(origin_of(server))
    page.get_by_label("Token").fill(token)
    page.keyboard.press("Enter")
    page.locator(".workspace").wait_for()


@pytest.fixture
def colleague(browser: Browser, server: RunningServer, page: Page) -> Iterator[Page]:
    """The page of another client, with the role `operate`; `page` was opened before."""
    made = server.client.post("/tokens", json={"name": "anna", "role": "operate"}).json()
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    other = context.new_page()
    log_in(other, server, made["token"])
    yield other
    context.close()
    server.client.put("/cells/yard/lease", json={"takeover": True})
    server.client.delete("/cells/yard/lease")
    server.client.delete("/tokens/anna")


ALONE = "anna has the lease of this cell; you may watch and stop."


def _check_moving(page: Page, refusal: str, may_disturb: bool, may_correct: bool) -> None:
    """Check which tools of the 3-D view move a thing, and what those say that do not."""
    for name, may in (("Move in reality", may_disturb), ("Correct belief", may_correct)):
        tool = page.get_by_role("button", name=name)
        expect(tool).to_be_enabled(enabled=may)
        if not may:
            expect(tool).to_have_attribute("title", refusal)


def lease_of(page: Page, word: str) -> None:
    """Wait until the bar on top says who has the lease, and open what it says about it."""
    page.get_by_role("button", name=f"Lease: {word}").click()


def test_only_the_page_with_the_lease_commands(page: Page, colleague: Page, server: RunningServer) -> None:
    server.client.put("/cells/yard/pace", json={"factor": 0.2})
    page.get_by_role("button", name="Correct belief").click()
    lease_of(colleague, "free")
    colleague.get_by_role("button", name="Take the lease").click()
    lease_of(page, "anna")
    expect(page.get_by_role("region", name="Lease of the cell")).to_contain_text("anna has the lease")
    check_axe(page, "lease")
    page.keyboard.press("Escape")
    expect(page.get_by_role("form", name="World model")).to_contain_text(ALONE)
    page.get_by_role("form", name="World model").get_by_role("button", name="Cancel").click()
    _check_moving(page, ALONE, may_disturb=False, may_correct=False)
    _check_moving(colleague, "This needs the role edit; you have operate.", may_disturb=True, may_correct=False)
    choose(page, "carry_all")
    expect(page.get_by_role("button", name="Start", exact=True)).to_be_disabled()
    expect(page.locator(".refusal")).to_have_text(ALONE)
    assert server.client.post("/cells/yard/operations", json={"task": "carry_all"}).status_code == 409
    start(colleague, "carry_all")
    wait_for_state(colleague, "running")
    page.keyboard.press("h")
    page.locator(".run-show", has_text="carry_all").first.click()
    expect(page.get_by_role("button", name="Pause")).to_be_disabled()
    expect(colleague.get_by_role("button", name="Pause")).to_be_enabled()
    page.get_by_role("button", name="Stop", exact=True).click()
    wait_for_state(colleague, "stopped")


def test_a_lease_is_released_and_taken_over_by_role(page: Page, colleague: Page, server: RunningServer) -> None:
    lease_of(page, "free")
    page.get_by_role("button", name="Take the lease").click()
    lease_of(colleague, "admin")
    expect(colleague.get_by_role("button", name="Take it over")).to_be_disabled()
    expect(colleague.get_by_text("This needs the role admin; you have operate.")).to_be_visible()
    page.get_by_role("button", name="Release the lease").click()
    colleague.get_by_role("button", name="Take the lease").click()
    page.keyboard.press("Escape")
    lease_of(page, "anna")
    page.get_by_role("button", name="Take it over").click()
    expect(colleague.get_by_role("button", name="Lease: admin")).to_be_visible()
    assert server.client.get("/cells/yard/lease").json()["owner"] == "admin"
    page.reload()
    expect(page.get_by_role("button", name="Lease: yours")).to_be_visible()


def test_who_may_only_see_is_told_before_trying(browser: Browser, server: RunningServer) -> None:
    made = server.client.post("/tokens", json={"name": "visitor", "role": "view"}).json()
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    log_in(page, server, made["token"])
    lease_of(page, "free")
    expect(page.get_by_role("button", name="Take the lease")).to_be_disabled()
    expect(page.get_by_text("This needs the role operate; you have view.")).to_be_visible()
    context.close()
    server.client.delete("/tokens/visitor")
