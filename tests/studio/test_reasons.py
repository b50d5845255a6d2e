"""Why: what `skillc why` says, asked in the page, with links to steps, individuals and lines."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from server.running import RunningServer
from studio.opening import FINISHED, start, wait_for_state


def test_questions_are_answered_with_links(page: Page, server: RunningServer) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    details = page.get_by_role("region", name="Details")
    details.get_by_role("button", name="Ask", exact=True).click()
    answer = details.locator(".explained")
    operation = server.client.get("/cells/yard/operations").json()[0]["id"]
    lines = server.client.get(f"/operations/{operation}/why").json()["lines"]
    assert len(lines) > 12
    expect(answer.locator(".explained-line")).to_have_count(len(lines))
    shown = "".join(answer.locator(".explained-line").all_text_contents())
    assert shown.split() == "".join(lines).split(), "the same words, whose columns are those of a terminal there"
    details.get_by_label("Question").fill("3")
    page.keyboard.press("Enter")
    expect(answer).to_contain_text("chosen: by_hand")
    answer.get_by_role("button", name="yard.skill:").first.click()
    expect(details.get_by_label("Source of yard.skill")).to_be_visible()


def test_a_call_is_explained_in_sentences(page: Page) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    page.locator(".plan-step", has_text="Unload").first.click()
    details = page.get_by_role("region", name="Details")
    details.get_by_role("button", name="Explain in sentences").click()
    expect(details.get_by_role("heading", name="Call 2")).to_be_visible()
    details.locator(".explained").get_by_role("button", name="lab:crate-0").first.click()
    expect(details).to_contain_text("lab:crate-0 is skiros:Product")
