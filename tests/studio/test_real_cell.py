"""The page with a cell whose arm a control process controls: the toy robot, without a library of any robot."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, expect

from control_process.served_toy import serving_toy
from server.running import RunningServer, wait_until
from studio.accessibility import check_axe
from studio.opening import EXPECTED_ERRORS, choose, open_studio, press_start, wait_for_state

pytestmark = pytest.mark.slow
PRESSED = "the emergency stop of the toy is pressed; release it"


def state_of_arm(server: RunningServer) -> object:
    """Return the state of the arm in the world model."""
    answer = server.client.get("/cells/yard/world", params={"subject": "lab:Iiwa-1", "limit": 1000})
    facts = [each["fact"] for each in answer.json()["facts"]]
    return next(each["value"] for each in facts if each.get("property", {}).get("label") == "deviceState")


def test_a_real_arm_is_shown_operated_and_its_stop_acknowledged(
    context: BrowserContext, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    problems: list[str] = []
    with serving_toy(tmp_path, monkeypatch) as (toy, server):
        page = context.new_page()
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda said: problems.append(said.text) if said.type == "error" else None)
        open_studio(page, server)
        arm = page.get_by_role("button", name="in control lab:Iiwa-1")
        expect(arm).to_contain_text("Hz")
        page.locator(".scene-menu summary").click()
        expect(page.get_by_label("Measured, command as ghost")).to_be_checked()
        expect(page.get_by_role("button", name="Move in reality")).to_be_disabled()
        for only_simulated in (page.get_by_label("Pace"), page.get_by_role("button", name="Reset or save the cell")):
            expect(only_simulated).to_have_count(0)
        choose(page, "swing")
        press_start(page)
        wait_for_state(page, "running", "swing")

        arm.click()
        report = page.get_by_role("region", name="How lab:Iiwa-1 is controlled")
        lost = report.locator("dt", has_text="Lost periods").locator("+ dd")
        before = int(lost.inner_text())
        toy.ask("lose", 5)
        wait_until(lambda: int(lost.inner_text()), lambda now: now > before)
        toy.ask("lose", 0)

        toy.ask("condition", "emergency-stop")
        wait_for_state(page, "failed", "swing")
        expect(page.get_by_role("alert").filter(has_text=PRESSED)).to_be_visible()
        expect(report).to_contain_text(PRESSED)
        check_axe(page, "real_arm")
        assert state_of_arm(server) == "Fault"
        acknowledge = page.get_by_role("button", name="Acknowledge")
        acknowledge.click()
        expect(page.locator(".messages")).to_contain_text(PRESSED)
        toy.ask("condition", "ready")
        acknowledge.click()
        page.get_by_text("operational", exact=True).wait_for()
        expect(arm).to_be_visible()
        assert state_of_arm(server) == "Idle"
        told = 'skillc_arm_state{arm="lab:Iiwa-1",cell="yard",state="in-control"} 1.0'
        wait_until(lambda: server.client.get("/metrics").text, lambda text: told in text)
        (control,) = [each["control"] for each in server.client.get("/cells/yard/robots").json() if each["control"]]
        assert (control["state"], control["lost_periods"] > 0) == ("in-control", True)
    assert [each for each in problems if not any(known in each for known in EXPECTED_ERRORS)] == []
