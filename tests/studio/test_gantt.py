"""The plan over time: what is expected and what happens, with a line that is now; what was left out, and why."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from server.running import RunningServer
from studio.accessibility import check_axe
from studio.opening import FINISHED, choose, press_start, wait_for_state


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_a_plan_is_shown_over_time_as_it_happens(page: Page, server: RunningServer, scheme: str) -> None:
    page.get_by_role("tab", name="Plan over time").click()
    panel = page.get_by_role("region", name="Signals and plan")
    expect(panel.get_by_text("Nothing to do").or_(panel.locator(".empty, .gantt")).first).to_be_visible()
    server.client.put("/cells/yard/pace", json={"factor": 0.25})
    choose(page, "carry_all")
    expect(panel.get_by_text("it has not been started")).to_be_visible()
    expect(panel.locator(".gantt-planned")).to_have_count(12)
    assert panel.locator(".gantt-ran, .gantt-now").count() == 0
    check_axe(page, f"gantt-before-{scheme}")
    press_start(page)
    wait_for_state(page, "running")
    expect(panel.get_by_text("it has not been started")).to_be_hidden()
    expect(panel.locator(".gantt-step")).to_have_count(12)
    expect(panel.locator(".gantt-planned")).to_have_count(12)
    expect(panel.locator(".gantt-now").first).to_be_visible()
    expect(panel.locator(".gantt-ran").nth(1)).to_be_visible()
    check_axe(page, f"gantt-{scheme}")
    server.client.put("/cells/yard/pace", json={"factor": None})
    wait_for_state(page, FINISHED)
    expect(panel.locator(".gantt-ran.is-success")).to_have_count(12)
    expect(panel.locator(".gantt-now")).to_have_count(0)
    panel.locator(".gantt-step").nth(3).click()
    expect(page.locator(".tree-row[aria-selected=true] .node-name")).to_have_text("Unload")
    expect(panel.locator(".gantt-step.is-selected")).to_have_count(1)
    expect(panel.get_by_role("region", name="About the plan")).to_contain_text("Fast Downward")
    page.keyboard.press("g")
    expect(panel.locator(".gantt")).to_be_hidden()


def test_a_task_with_a_body_says_that_it_has_no_plan(page: Page) -> None:
    page.get_by_role("tab", name="Plan over time").click()
    choose(page, "carry_two")
    press_start(page)
    wait_for_state(page, FINISHED, "carry_two")
    expect(page.get_by_text("This task has a body, and no plan")).to_be_visible()
