"""Who may see and do what, and names that would be markup."""

from __future__ import annotations

from playwright.sync_api import BrowserContext, Page, expect

from server.running import RunningServer
from studio.opening import make_code, origin_of, put_back


def test_a_code_is_good_once_and_leaves_the_address(context: BrowserContext, server: RunningServer) -> None:
    page = context.new_page()
    address = f"{origin_of(server)}/#code={make_code(server)}"
    page.goto(address)
    page.locator(".workspace").wait_for()
    assert page.url == f"{origin_of(server)}/"
    page.get_by_role("button", name="admin").click()
    page.get_by_role("button", name="Log in").wait_for()
    page.goto(address)
    page.reload()
    expect(page.get_by_role("button", name="Log in")).to_be_visible()


def test_a_token_that_is_wrong_is_refused_with_a_reason(context: BrowserContext, server: RunningServer) -> None:
    page = context.new_page()
    page.goto(origin_of(server))
    page.get_by_label("Token").fill("wrong")
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert")).to_have_text("This token is not valid, or was revoked.")
    page.get_by_label("Token").fill(server.token)
    page.keyboard.press("Enter")
    page.locator(".workspace").wait_for()


def test_who_may_only_see_cannot_start_but_can_stop(context: BrowserContext, server: RunningServer) -> None:
    put_back(server)
    server.client.put("/cells/yard/pace", json={"factor": 0.2})
    made = server.client.post("/tokens", json={"name": "visitor", "role": "view"}).json()
    page = context.new_page()
    page.goto(origin_of(server))
    page.get_by_label("Token").fill(made["token"])
    page.keyboard.press("Enter")
    page.locator(".workspace").wait_for()
    page.keyboard.press("r")
    page.get_by_role("button", name="carry_all").click()
    page.locator(".preview-step").first.wait_for()
    expect(page.get_by_role("button", name="Start", exact=True)).to_be_disabled()
    operation = server.submit(task="carry_all")
    page.keyboard.press("h")
    page.locator(".run-show", has_text="carry_all").first.click()
    expect(page.get_by_role("button", name="Pause")).to_be_disabled()
    page.get_by_role("button", name="Stop", exact=True).click()
    server.wait_for(operation["id"], "stopped")
    server.client.delete("/tokens/visitor")
    expect(page.get_by_role("button", name="Log in")).to_be_visible()


def test_names_with_markup_are_text(page: Page, server: RunningServer) -> None:
    markup = "<img src=x onerror=document.title='broken'><b>bold</b>"
    edit = {"edits": [f'lab:crate-0 skiros:FrameId "{markup}"'], "why": markup}
    assert server.client.post("/cells/yard/world/edits", json=edit).status_code == 204
    submitted = server.client.post("/cells/yard/operations", json={"goal": f'lab:crate-0.FrameId == "{markup}"'})
    assert submitted.status_code in (201, 409, 422), submitted.text
    page.reload()
    page.locator(".workspace").wait_for()
    page.keyboard.press("f")
    page.get_by_label("Search in the facts").fill("FrameId")
    expect(page.get_by_role("region", name="Details")).to_contain_text(markup)
    page.get_by_label("What to show").select_option("history")
    expect(page.get_by_role("region", name="Details")).to_contain_text(markup)
    page.keyboard.press("h")
    assert page.locator("img, b").count() == 0
    assert page.title() == "skillc studio"


def test_an_edit_says_why_and_is_in_the_history(page: Page) -> None:
    page.keyboard.press("f")
    page.get_by_role("button", name="Add", exact=True).click()
    page.get_by_role("button", name="Several facts").click()
    page.get_by_label("Fact 1").fill('lab:crate-1.FrameId == "moved"')
    change = page.get_by_role("button", name="Change", exact=True)
    expect(change).to_be_disabled()
    page.get_by_label("Why", exact=True).fill("it was renamed")
    change.click()
    page.get_by_label("Search in the facts").fill("moved")
    expect(page.locator(".world tbody tr")).to_have_count(1)
    page.get_by_role("button", name="Add", exact=True).click()
    page.get_by_role("button", name="Several facts").click()
    page.get_by_label("Fact 1").fill("lab:crate-1 nonsense")
    page.get_by_label("Why", exact=True).fill("to see what is said")
    change.click()
    expect(page.get_by_role("alert").filter(has_text="nonsense")).to_be_visible()
    expect(page.get_by_label("Fact 1")).to_have_value("lab:crate-1 nonsense")
