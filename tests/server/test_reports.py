"""The report of an operation is made by running it again from its recording, beside the cell."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import skillc
from server.running import RunningServer
from waiting import LONG_S

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-0", "to": "lab:Goal"}}


def test_a_report_has_result_and_pages_that_a_browser_runs_no_script_of(server: RunningServer) -> None:
    server.put_back()
    files = server.folder / "served/jobs"
    before = [*files.glob("*")]
    operation = server.submit(**CARRY)["id"]
    server.wait_for(operation, "succeeded")
    begun = server.begin("report", operation=operation)
    assert (begun["cell"], begun["owner"]) == ("yard", "admin")
    made = server.wait_for_job(begun["id"])
    assert made["reason"] == "" and server.find_outcome(made["id"])["run"]["status"] == "succeeded"
    path = f"/jobs/{made['id']}"
    assert {"report.html", "result.json"} <= set(made["files"])
    page = server.client.get(f"{path}/files/report.html")
    assert page.status_code == 200 and page.headers["content-type"].startswith("text/html")
    assert page.headers["content-security-policy"].startswith("sandbox; default-src 'none'")
    for name in ("..%2f..%2fadmin.token", "nothing.html", "%2fetc%2fpasswd"):
        assert server.client.get(f"{path}/files/{name}").status_code == 404
    assert server.client.delete(path).status_code == 204
    assert server.client.get(path).status_code == server.client.get(f"{path}/files/report.html").status_code == 404
    assert [*files.glob("*")] == before


def test_no_report_is_made_of_what_goes_on(server: RunningServer) -> None:
    server.put_back()
    operation = server.submit(task="carry_all", approve=True)["id"]
    server.wait_for(operation, "planned")
    refused = server.client.post("/jobs", json={"kind": "report", "operation": operation})
    assert refused.status_code == 409 and "is planned: a report is made of what has ended" in refused.text
    server.client.post(f"/operations/{operation}/stop", json={})


@pytest.mark.sim
def test_clients_write_it_to_a_folder(server: RunningServer, tmp_path: Path) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    with skillc.connect(server.url.removesuffix("/api/v1"), server.token) as connected:
        operation = connected.cell().start("carry", arguments=CARRY["arguments"])
        operation.wait(timeout_s=LONG_S)
        report = operation.report(tmp_path / "report")
    assert report.status == "succeeded"
    assert json.loads((tmp_path / "report/result.json").read_text())["status"] == "succeeded"
    assert (tmp_path / "report/report.html").exists()
