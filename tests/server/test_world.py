"""The world of a running cell: listed, queried, edited by a person, with its history; hostile queries end."""

from __future__ import annotations

import time
from typing import Any

import pytest

from server.running import RunningServer


def ask(server: RunningServer, sparql: str) -> Any:
    return server.client.post("/cells/yard/world/query", json={"sparql": sparql})


def edit(server: RunningServer, *edits: str, why: str = "it was found there") -> Any:
    return server.client.post("/cells/yard/world/edits", json={"edits": edits, "why": why})


def places(server: RunningServer, crate: str) -> list[str]:
    rows = ask(server, f"SELECT ?place {{ ?place skiros:contain lab:{crate} }}").json()["rows"]
    return [row[0] for row in rows]


def test_facts_are_listed_with_how_they_are_known(server: RunningServer) -> None:
    server.put_back()
    found = server.client.get("/cells/yard/world", params={"subject": "lab:Start"}).json()
    assert found["total"] == len(found["facts"]) == 7
    contained = [each for each in found["facts"] if each["fact"]["type"] == "relation"]
    assert {each["fact"]["object"]["label"] for each in contained} == {f"lab:crate-{number}" for number in range(6)}
    assert {each.get("evidence") for each in contained} <= {None, "assumed"}
    crates = server.client.get("/cells/yard/world", params={"type": "skiros:Product", "limit": 2, "offset": 5}).json()
    assert crates["total"] == 6 and [each["fact"]["individual"]["label"] for each in crates["facts"]] == ["lab:crate-5"]
    refused = server.client.get("/cells/yard/world", params={"subject": "lab:Strat"})
    assert refused.status_code == 422 and "did you mean lab:Start?" in refused.json()["detail"]


def test_a_person_edits_the_world_and_the_history_says_who_and_why(server: RunningServer) -> None:
    server.put_back()
    assert edit(server, "lab:other a skiros:Product").status_code == 204
    assert edit(server, "not lab:other").status_code == 204
    assert edit(server, "lab:Goal skiros:contain lab:crate-3", "lab:spare a skiros:Product").status_code == 204
    assert places(server, "crate-3") == ["lab:Goal"]
    (last,) = server.client.get("/cells/yard/world/history", params={"limit": 1}).json()
    assert last["origin"] == "admin: it was found there" and last["evidence"] is None
    assert abs(last["written_ns"] - time.time_ns()) < 60e9
    assert [each["type"] for each in last["changes"]] == ["relation", "added"]
    older = server.client.get("/cells/yard/world/history", params={"before": last["sequence"], "limit": 1}).json()
    assert [each["sequence"] for each in older] == [last["sequence"] - 1]
    assert edit(server, "not lab:spare").status_code == 204
    assert edit(server, "lab:Start skiros:contain lab:crate-3").status_code == 204


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("lab:Goal skiros:contain lab:crate-33", "no individual lab:crate-33; did you mean"),
        ("lab:Goal skiros:contains lab:crate-3", "no term skiros:contains; did you mean skiros:contain"),
        ("lab:Goal skiros:contain", "`lab:Goal skiros:contain`: "),
        ("nowhere:Goal skiros:contain lab:crate-3", "nowhere"),
        ("lab:crate-3 skiros:Weight 'heavy'", "it takes"),
        ("lab:Goal a lab:Crat", "no term lab:Crat"),
        ("lab:Goal skiros:contain lab:Goal", "contain"),
    ],
)
def test_an_edit_that_is_wrong_changes_nothing(server: RunningServer, wrong: str, said: str) -> None:
    before = server.client.get("/cells/yard/world").json()
    answer = edit(server, "lab:Goal skiros:contain lab:crate-2", wrong)
    assert answer.status_code == 409 and said in answer.json()["detail"], answer.text
    assert server.client.get("/cells/yard/world").json() == before


def test_an_operation_sees_what_a_person_states_while_it_runs(server: RunningServer) -> None:
    server.put_back(pace=0.1)
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    assert edit(server, "lab:Goal skiros:contain lab:crate-5").status_code == 204
    server.client.put("/cells/yard/pace", json={"factor": None})
    assert server.wait_for(operation, "succeeded", "failed")["state"] == "succeeded"
    events = server.client.get(f"/operations/{operation}/events").json()
    assert any("crate-5" in str(each["event"]) for each in events if each["event"]["type"] == "world-changed")


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("SELECT * { SERVICE <http://127.0.0.1:9/sparql> { ?s ?p ?o } }", "SERVICE"),
        ("select * { ServicE silent <http://127.0.0.1:9/sparql> { ?s ?p ?o } }", "ervic"),
        ("LOAD <http://127.0.0.1:9/x>", "LOAD"),
        ("INSERT DATA { lab:Goal skiros:contain lab:crate-0 }", "INSERT"),
        ("PREFIX x: <http://127.0.0.1:9/> SELECT * FROM x:y { ?s ?p ?o }", ""),
        ("SELECT * { ?s ?p", ""),
        (f"SELECT * {{ {'{' * 5000} ?s ?p ?o {'}' * 5000} }}", ""),
    ],
)
def test_a_query_reads_this_world_only(server: RunningServer, query: str, said: str) -> None:
    answer = ask(server, query)
    if answer.status_code == 200:
        assert answer.json()["rows"] == [], "a graph that is not here has no triples"
    else:
        assert answer.status_code == 422 and said in answer.json()["detail"], answer.text
