"""`skillc studio` starts a server or uses the one that runs, and opens its page with a code that logs in once."""

from __future__ import annotations

import signal
import subprocess
import sys
import webbrowser
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest
from click.testing import CliRunner, Result

from running_cells.yard import write_yard
from skillc.cli.main import skillc
from skillc.errors import RequestError
from skillc.services.library.files import SHIPPED
from skillc.services.tasks.studio_choice import choose_studio
from waiting import LONG_S

STATE = ("--state", "served", "--no-browser")


@pytest.fixture(scope="module")
def yard(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("studio")
    write_yard(folder)
    (folder / "other.ttl").write_text((folder / "yard.ttl").read_text())
    return folder


def run(folder: Path, command: Sequence[str]) -> subprocess.Popen[str]:
    """Run a command in a folder."""
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


@pytest.fixture(scope="module")
def started(yard: Path) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The process of a studio, and the address that it has printed; the server before it was killed."""
    (yard / "served").mkdir()
    (yard / "served" / "address").write_text("http://127.0.0.1:9\n")
    (yard / "served" / "admin.token").write_text("skillc_old\n")
    command = (sys.executable, "-m", "skillc", "studio", ".:carry_all", *STATE, "--backend", "kinematic")
    with run(yard, command) as process:
        assert process.stdout is not None
        try:
            yield process, process.stdout.readline().strip()
        finally:
            process.send_signal(signal.SIGTERM)
            process.wait(LONG_S)
    assert not (yard / "served" / "address").exists()


def open_page(address: str) -> tuple[str, dict[str, list[str]], httpx.Client]:
    """Return the address without its fragment, the values in that, and a browser that has logged in."""
    split = urlsplit(address)
    page, about = f"{split.scheme}://{split.netloc}", parse_qs(split.fragment)
    assert not split.query and split.path == "/", "a server never gets a code in an address"
    browser = httpx.Client(base_url=f"{page}/api/v1", headers={"Origin": page})
    answer = browser.post("/session", headers={"Authorization": f"Bearer {about['code'][0]}"})
    assert answer.status_code == 204
    return page, about, browser


def studio(folder: Path, monkeypatch: pytest.MonkeyPatch, *arguments: str) -> Result:
    monkeypatch.chdir(folder)
    return CliRunner().invoke(skillc, ["studio", *arguments, *STATE])


def test_after_a_server_that_was_killed_it_starts_one_and_its_code_logs_in_once(
    started: tuple[subprocess.Popen[str], str],
) -> None:
    page, about, browser = open_page(started[1])
    with closing(browser):
        assert browser.get("/session").json() == {"name": "admin", "role": "admin"}
        assert (about["task"], about["cell"]) == (["carry_all"], ["yard"])
        assert [each["name"] for each in browser.get("/cells").json()] == ["yard"]
        assert browser.post("/session", headers={"Authorization": f"Bearer {about['code'][0]}"}).status_code == 401
    assert httpx.get(page).status_code == 200


def test_a_server_that_runs_is_used(
    yard: Path, started: tuple[subprocess.Popen[str], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    again = studio(yard, monkeypatch, ".")
    assert again.exit_code == 0, again.output
    page, about, browser = open_page(again.output.strip())
    browser.close()
    assert about["cell"] == ["yard"] and "task" not in about
    assert started[1].startswith(page) and again.output.strip() != started[1]
    refused = studio(yard, monkeypatch, ".", "--cell", "other.ttl")
    assert refused.exit_code == 2 and "has no cell other; end it, or give another --state" in refused.output


def names(choice_of: str | None, scenes: Sequence[Path] = ()) -> tuple[str, list[str], str]:
    choice = choose_studio(choice_of, scenes)
    assert choice.cell == ("" if choice_of is None or not choice.scenes else choice.scenes[0].stem)
    return choice.library.name, [each.stem for each in choice.scenes], choice.task


def test_a_library_or_a_task_determines_the_cells(yard: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    assert names("clean_whiteboard") == ("wiping", ["ur5e_whiteboard"], "clean_whiteboard")
    assert names("sorting:sort_parts") == ("sorting", ["panda"], "sort_parts")
    library, scenes, task = names(None)
    assert (library, task) == ("wiping", "") and {"ur5e_whiteboard", "iiwa_table"} <= set(scenes) and len(scenes) <= 4
    assert names("wiping") == names(None)
    (tmp_path / "bare.skill").write_text("## Nothing to do yet.\n")
    assert names("bare.skill") == ("bare.skill", [], "")
    assert names(str(yard)) == (yard.name, ["yard"], "")
    assert names(str(yard / "yard.skill"))[0] == "yard.skill"
    assert names("clean_whiteboard", (SHIPPED / "sorting" / "panda.ttl",))[1] == ["panda"]


@pytest.mark.parametrize(
    ("what", "message"),
    [
        ("clean_whitebord", "there is no library and no task `clean_whitebord`; did you mean `clean_whiteboard`?"),
        ("wiping:clean_everything_at_once", "there is no library and no task"),
        ("nowhere.skill", "there is no file or folder nowhere.skill"),
        ("nowhere:task", "there is no file or folder nowhere"),
    ],
)
def test_what_does_not_exist_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, what: str, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(RequestError, match=message):
        choose_studio(what, ())


@pytest.mark.parametrize("display", ["", ":0"])
def test_a_browser_is_opened_where_it_can_be_seen(
    yard: Path, started: tuple[subprocess.Popen[str], str], monkeypatch: pytest.MonkeyPatch, display: str
) -> None:
    opened = list[str]()
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) is None)
    for name in ("WAYLAND_DISPLAY", "BROWSER", "DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    if display:
        monkeypatch.setenv("DISPLAY", display)
    monkeypatch.chdir(yard)
    done = CliRunner().invoke(skillc, ["studio", "--state", "served", "."])
    assert done.exit_code == 0, done.output
    (address,) = opened if display else done.output.split()
    assert address.startswith(started[1].partition("#")[0]) and (display == "") == bool(done.output)
