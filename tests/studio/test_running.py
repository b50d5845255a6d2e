"""A run from its choice to its end, with the mouse and with the keyboard alone."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from server.running import RunningServer
from studio.opening import FINISHED, choose, choose_planned, press_start, start, wait_for_state

pytestmark = pytest.mark.early

APPROVE, STEP = (
    "Let each plan, also a new one, wait for approval",
    "Pause before the first call, and go on step by step",
)
"""Two fields of the form of a start."""


def test_three_clicks_run_a_task(page: Page) -> None:
    page.keyboard.press("r")
    page.get_by_role("button", name="carry_all").click()
    expect(page.locator(".preview-step")).to_have_count(12)
    planned = page.locator(".preview-step > span:nth-child(2)").all_inner_texts()
    press_start(page)
    wait_for_state(page, FINISHED)
    expect(page.locator(".plan-step .is-good")).to_have_count(12)
    expect(page.locator(".run")).to_contain_text(re.compile(r"submitted .*, started .*, ended .* after [\d.]+ s"))
    lefts = page.locator(".plan-step .span-bar").evaluate_all("all => all.map((each) => parseFloat(each.style.left))")
    assert lefts == sorted(lefts) and lefts[0] < 30, "bars begin where the operation began, however old the cell is"
    page.get_by_role("button", name="Enlarge Tree").click()
    page.keyboard.press("2")
    page.keyboard.press("Home")
    expect(page.locator(".tree-row").first).to_have_attribute("aria-posinset", "1")
    names = page.locator(".tree-row[aria-level='1'] .node-name").all_inner_texts()
    assert len(names) > 4
    assert names == planned[: len(names)]


def test_a_step_is_one_selection_in_all_views(page: Page) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    page.locator(".plan-step", has_text="Unload").first.click()
    expect(page.locator(".tree-row[aria-selected=true] .node-name")).to_have_text("Unload")
    details = page.get_by_role("region", name="Details")
    expect(details).to_contain_text("Unload[by_hand]")
    expect(details).to_contain_text("Why by_hand")
    expect(details.get_by_role("button", name="yard.skill:").first).to_be_visible()
    details.get_by_role("button", name="Explain in sentences").click()
    details.locator(".origins").get_by_role("button", name="crate", exact=True).click()
    expect(details.locator(".explained")).to_have_count(2)
    details.get_by_role("button", name="lab:Cart-1").first.click()
    expect(details).to_contain_text("lab:Cart-1 is lab:Cart")
    page.keyboard.press("f")
    expect(details.locator("tr.is-selected").first).to_contain_text("lab:Cart-1")


def _tab_to(page: Page, text: str) -> None:
    """Go to what begins with a text, or belongs to a label with it, with the tabulator alone."""
    for _ in range(100):
        page.keyboard.press("Tab")
        found = page.evaluate("document.activeElement.textContent || document.activeElement.labels?.[0]?.textContent")
        if (found or "").strip().startswith(text):
            return
    raise AssertionError(f"the tabulator does not reach {text}")


def _press(page: Page, *texts: str) -> None:
    """Press or check with the keyboard what has each text."""
    for text in texts:
        _tab_to(page, text)
        is_box = page.evaluate("document.activeElement.type === 'checkbox'")
        page.keyboard.press("Space" if is_box else "Enter")


def test_the_keyboard_alone_does_a_whole_run(page: Page, server: RunningServer) -> None:
    server.client.put("/cells/yard/pace", json={"factor": 0.2})
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").wait_for()
    _press(page, "carry_all")
    page.locator(".preview-step").first.wait_for()
    _press(page, APPROVE, STEP, "Start")
    wait_for_state(page, "waits for approval")
    page.get_by_role("button", name="Approve the plan").wait_for()
    _press(page, "Approve the plan")
    wait_for_state(page, "paused")
    page.keyboard.press("n")
    expect(page.locator(".tree-row[aria-level='1'].is-success")).to_have_count(1)
    wait_for_state(page, "paused")
    page.keyboard.press("p")
    wait_for_state(page, "running")
    page.keyboard.press("p")
    wait_for_state(page, "paused")
    server.client.put("/cells/yard/pace", json={"factor": None})
    page.keyboard.press("p")
    wait_for_state(page, FINISHED)
    page.keyboard.press("2")
    page.keyboard.press("Home")
    page.keyboard.press("ArrowDown")
    expect(page.locator(".tree-row[aria-selected=true]")).to_have_count(1)
    page.keyboard.press("?")
    expect(page.get_by_role("dialog")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_be_hidden()


def test_the_keyboard_alone_answers_a_question_and_reads_the_report(page: Page) -> None:
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").wait_for()
    _press(page, "confirm", "Start")
    expect(page.get_by_role("alert").filter(has_text="Is the cart free?")).to_be_visible()
    _press(page, "yes")
    wait_for_state(page, "succeeded", "confirm")
    page.keyboard.press("h")
    page.locator(".run-item").first.wait_for()
    _press(page, "Report")
    made = page.get_by_role("link", name="Open report")
    expect(made).to_be_focused()
    with page.expect_popup() as opened:
        page.keyboard.press("Enter")
    expect(opened.value.get_by_role("heading").first).to_contain_text("confirm")


def test_pause_step_resume_and_stop(page: Page, server: RunningServer) -> None:
    server.client.put("/cells/yard/pace", json={"factor": 0.2})
    choose_planned(page, "carry_all")
    page.get_by_label(STEP).check()
    press_start(page)
    wait_for_state(page, "paused")
    steps = page.locator(".tree-row[aria-level='1']")
    expect(steps).to_have_count(12)
    for number in (1, 2):
        page.get_by_role("button", name="Step over").click()
        expect(steps.and_(page.locator(".is-success"))).to_have_count(number)
        wait_for_state(page, "paused")
    page.get_by_role("button", name="Resume").click()
    wait_for_state(page, "running")
    page.keyboard.press("p")
    wait_for_state(page, "paused")
    page.get_by_role("button", name="Stop", exact=True).click()
    wait_for_state(page, "stopped")


def test_a_paused_run_says_which_step_is_next_and_goes_on_by_a_button(page: Page, server: RunningServer) -> None:
    operation = server.submit(task="carry_all", breakpoints=["Unload"])["id"]
    server.wait_for(operation, "paused")
    page.locator(".strip-item", has_text="breakpoint at Unload").click()
    run = page.locator(".run")
    for crate in (0, 1):
        expect(run).to_contain_text(re.compile(rf"Next: Unload lab:Cart-1, lab:crate-{crate}, lab:Goal"))
        run.get_by_role("button", name="Go on").click()
    page.get_by_role("button", name="Stop", exact=True).click()
    server.wait_for(operation, "stopped")


def test_a_goal_with_completion_and_one_that_is_impossible(page: Page) -> None:
    page.keyboard.press("r")
    goal = page.get_by_role("combobox", name="Goal")
    goal.click()
    goal.fill("lab:Goal contain lab:crate-")
    page.get_by_role("option", name="lab:crate-3").wait_for()
    goal.press("ArrowDown")
    goal.press("Enter")
    expect(goal).to_have_value("lab:Goal contain lab:crate-1")
    page.get_by_role("button", name="Plan for this goal").click()
    expect(page.locator(".preview-step")).to_have_count(2)
    page.get_by_role("button", name="all tasks").click()
    page.get_by_role("combobox", name="Goal").fill("lab:Start contain lab:Start")
    page.get_by_role("button", name="Plan for this goal").click()
    expect(page.locator(".run .notice").first).to_be_visible()


def test_a_task_with_parameters_asks_for_them(page: Page) -> None:
    choose(page, "carry")
    page.get_by_role("list", name="Tasks").get_by_role("button", name="carry(", exact=False)
    crate = page.get_by_role("combobox", name="crate")
    crate.fill("lab:crate-2")
    crate.press("Escape")
    page.get_by_role("combobox", name="to", exact=True).fill("lab:Goal")
    expect(page.locator(".preview-step")).to_have_count(2)
    page.get_by_role("button", name="Rehearse").click()
    expect(page.locator(".rehearsed")).to_contain_text(FINISHED, timeout=120_000)  # a twin of the cell starts
    page.get_by_role("button", name="Play it").click()
    expect(page.get_by_text("rehearsal of carry")).to_be_visible()
    expect(page.locator(".tree-row[aria-level='1'].is-success")).to_have_count(2)
    page.get_by_role("button", name="Back to the cell").click()
    press_start(page)
    wait_for_state(page, FINISHED, "carry")


def test_the_plan_waits_for_approval(page: Page) -> None:
    choose_planned(page, "carry_all")
    page.get_by_label(APPROVE).check()
    press_start(page)
    wait_for_state(page, "waits for approval")
    page.get_by_role("button", name="Approve the plan").click()
    wait_for_state(page, FINISHED)
