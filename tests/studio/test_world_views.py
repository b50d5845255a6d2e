"""The world: its graph, what differs between two times, and the undo of an edit with who and why."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, Route, expect

from server.running import RunningServer
from studio.accessibility import check_axe

pytestmark = pytest.mark.early


def edit(server: RunningServer, text: str, why: str) -> None:
    assert server.client.post("/cells/yard/world/edits", json={"edits": [text], "why": why}).status_code == 204


def show(page: Page, what: str) -> None:
    page.keyboard.press("f")
    page.get_by_label("What to show").select_option(label=what)


def add_while_terms_are_late(page: Page) -> list[Route]:
    """Open the form for a new fact about a crate; the requests for what can be stated stay unanswered."""
    late: list[Route] = []
    page.route("**/world/terms*", lambda route: late.append(route))
    show(page, "facts")
    page.get_by_label("Search in the facts").fill("contain lab:crate-4")
    page.locator(".world tbody button.link", has_text="crate-4").first.click()
    page.get_by_role("button", name="Add", exact=True).click()
    return late


def test_an_edit_is_undone_with_who_and_why(page: Page, server: RunningServer) -> None:
    edit(server, 'lab:crate-2 skiros:FrameId "first"', "it has a name")
    edit(server, 'lab:crate-2 skiros:FrameId "second"', "it has another name")
    page.reload()
    page.locator(".workspace").wait_for()
    show(page, "who changed what")
    row = page.locator(".world tbody tr", has_text="it has another name").first
    row.get_by_role("button", name="Undo").click()
    expect(page.get_by_label("Fact 1")).to_have_value('lab:crate-2.FrameId == "first"')
    expect(page.get_by_label("Why", exact=True)).to_have_value("undoes “admin: it has another name”")
    page.get_by_role("button", name="Change", exact=True).click()
    undone = page.locator(".world tbody tr", has_text="admin: undoes").first
    expect(undone).to_contain_text('lab:crate-2.FrameId == "first"')
    facts = server.client.get("/cells/yard/world", params={"subject": "lab:crate-2"}).json()["facts"]
    assert any(each["fact"].get("value") == "first" for each in facts)


def test_a_fact_is_edited_by_a_click_and_the_edit_undone(page: Page, server: RunningServer) -> None:
    """A place is chosen among those that there are, a quantity has its unit, and nobody writes Turtle."""
    show(page, "facts")
    facts = page.locator(".world tbody tr")
    search, why = page.get_by_label("Search in the facts"), page.get_by_label("Why", exact=True)
    search.fill("contain lab:crate-4")
    facts.first.locator(".fact-edit").click()
    value = page.get_by_label("Value", exact=True)
    value.fill("")
    value.press_sequentially("crate-5")
    value.press("Enter")
    expect(value).to_have_value("lab:crate-5")
    expect(page.get_by_role("button", name="Change", exact=True)).to_be_disabled()
    page.get_by_role("button", name="Cancel").click()
    page.get_by_role("button", name="Add", exact=True).click()
    page.get_by_label("Thing", exact=True).fill("lab:crate-4")
    page.get_by_label("What is stated").select_option(label="Weight: Mass")
    value.fill("1200 g")
    why.fill("weighed")
    page.get_by_role("button", name="Add", exact=True).last.click()
    search.fill("crate-4.Weight")
    expect(facts.first).to_contain_text("lab:crate-4.Weight == 1.2 kg")
    page.get_by_role("button", name="Undo", exact=True).click()
    expect(page.get_by_text("No fact has")).to_be_visible()


def test_what_was_refused_stays_told_when_a_slow_answer_comes(page: Page) -> None:
    """What a form can state is read while somebody edits already; its answer takes no message away."""
    late = add_while_terms_are_late(page)
    page.get_by_role("button", name="Several facts").click()
    page.get_by_label("Fact 1").fill("lab:crate-4 nonsense lab:crate-5")
    page.get_by_label("Why", exact=True).fill("it is tried")
    page.get_by_role("button", name="Change", exact=True).click()
    refusal = page.get_by_role("alert").filter(has_text="nonsense")
    refusal.wait_for()
    assert late
    with page.expect_response("**/world/terms*"):
        for each in late:
            each.continue_()
    page.wait_for_load_state("networkidle")
    expect(refusal).to_be_visible()


def test_what_a_skill_changed_has_no_undo(page: Page, server: RunningServer) -> None:
    server.wait_for(server.submit(goal="lab:Goal contain lab:crate-0")["id"], "succeeded")
    show(page, "who changed what")
    row = page.locator(".world tbody tr", has_text="Unload").first
    expect(row).to_be_visible()
    expect(row.get_by_role("button", name="Undo")).to_have_count(0)


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_what_differs_between_two_times(page: Page, server: RunningServer, scheme: str) -> None:
    edit(server, "lab:Goal skiros:contain lab:crate-3", "it was carried by hand")
    page.reload()
    page.locator(".workspace").wait_for()
    show(page, "between two times")
    begin = server.client.get("/cells/yard/world/history").json()[1]["sequence"]
    page.get_by_label("From").select_option(str(begin))
    row = page.locator(".world tbody tr", has_text="Goal contain lab:crate-3")
    expect(row).to_contain_text("yes")
    expect(row).to_contain_text("admin: it was carried by hand")
    check_axe(page, f"world-times-{scheme}")
    last = page.get_by_label("To", exact=True).input_value()
    page.get_by_label("From").select_option(last)
    expect(page.get_by_text("The second time is not after the first one.")).to_be_visible()


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_the_graph_is_beside_the_table_and_shares_the_selection(page: Page, scheme: str) -> None:
    show(page, "graph")
    graph = page.locator(".world-graph")
    expect(graph.locator(".graph-node")).to_have_count(7)  # the place of all crates, and six crates
    graph.get_by_role("button", name="lab:crate-4").focus()
    page.keyboard.press("Enter")
    expect(graph.locator(".is-centre")).to_contain_text("lab:crate-4")
    page.get_by_label("What to show").select_option(label="facts")
    page.get_by_role("button", name="Enlarge Details").click()
    expect(graph.locator(".is-centre")).to_contain_text("lab:crate-4")
    expect(page.locator(".world tr.is-selected").first).to_contain_text("lab:crate-4")
    check_axe(page, f"world-graph-{scheme}")
    page.keyboard.press("m")


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_what_robots_can_do_is_found_by_a_word(page: Page, scheme: str) -> None:
    show(page, "what robots can do")
    row = page.locator(".world table.skills tbody tr").filter(has=page.get_by_role("cell", name="Unload", exact=True))
    expect(row).to_contain_text("contain")
    expect(row).to_contain_text("the cell has no robot")
    page.get_by_label("Search in the skills").fill("no such skill")
    expect(page.locator(".world .empty")).to_have_text("No skill has “no such skill” in it.")
    page.get_by_label("Search in the skills").fill("")
    expect(row).to_be_visible()
    check_axe(page, f"world-skills-{scheme}")


def test_a_new_fact_does_not_move_under_a_click_when_what_can_be_stated_is_known(page: Page) -> None:
    late = add_while_terms_are_late(page)
    terms = page.get_by_label("What is stated")
    expect(terms).to_be_disabled()
    several = page.get_by_role("button", name="Several facts")
    before = several.bounding_box()
    while not late:
        page.wait_for_timeout(10)
    late[0].continue_()
    expect(terms).to_be_enabled()
    assert several.bounding_box() == before
