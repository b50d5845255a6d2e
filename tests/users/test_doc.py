"""`skillc doc`: every link leads somewhere, what authors wrote stays text, the same input gives the same bytes."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from posixpath import dirname, join, normpath

import pytest
from click.testing import CliRunner

from skillc.cli.commands.doc import command
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_compiler.emit.docs import prose
from skillc_compiler.emit.docs.site import make_site
from skillc_compiler.emit.docs.skill_page import reasons
from skillc_compiler.resolve.files import read_sources

WIPING = SHIPPED / "wiping"
RANKED = """
use rparts, skillc

## <script>alert(1)</script> & *all* of [this](javascript:alert(1))
skill Hold {
    in gripper: GripperEffector
    in name:    Text
    noplan
}
impl any_hand of Hold { do wait 1 s }
impl first_choice of Hold { prefer 2  do wait 1 s }
impl narrow of Hold { refine gripper: ParallelGripper  do wait 1 s }
impl narrower of Hold { refine gripper: WsgGripper  do wait 1 s }
impl other of Hold { refine gripper: ThreeFingerGripper  do wait 1 s }
"""


class Page(HTMLParser):
    """The links, ids, headings and loaded files of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: list[str] = []
        self.levels: list[int] = []
        self.loaded: list[str] = []
        self.in_main = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.in_main = self.in_main or tag == "main"
        self.ids += [values["id"]] if "id" in values else []
        self.links += [values["href"]] if tag == "a" else []
        self.loaded += [values[name] for name in ("src", "href") if tag in {"script", "link", "img"} and name in values]
        if self.in_main and re.fullmatch("h[1-6]", tag):
            self.levels.append(int(tag[1]))

    def handle_endtag(self, tag: str) -> None:
        self.in_main = self.in_main and tag != "main"


@cache
def made() -> dict[str, str]:
    library = find_library(WIPING)
    return make_site(
        libraries.compile_library(library).value, read_sources(library.sources, library.importable, library.name).value
    )


@cache
def parsed() -> dict[str, Page]:
    return {path: Page(text) for path, text in made().items() if path.endswith(".html")}


def test_every_link_leads_to_a_place_that_exists() -> None:
    followed = 0
    for path, page in parsed().items():
        for link in page.links:
            target, _, place = link.partition("#")
            where = normpath(join(dirname(path), target)) if target else path
            assert where in made(), f"{path}: {link}"
            assert not place or place in parsed()[where].ids, f"{path}: {link}"
            followed += 1
    assert followed > 500


def test_pages_load_nothing_but_their_own_files_and_have_order() -> None:
    assert len(parsed()) > 20
    for path, page in parsed().items():
        assert {normpath(join(dirname(path), each)) for each in page.loaded} == {"style.css", "search.js"}
        assert max(Counter(page.ids).values()) == 1, path
        assert page.levels[0] == 1
        assert page.levels.count(1) == 1
        assert all(deeper <= level + 1 for level, deeper in zip(page.levels, page.levels[1:], strict=False)), path


def test_a_page_shows_what_its_skill_says() -> None:
    text = re.sub("<[^>]*>", "", made()["skill/Wipe.html"])
    for words in (
        "0.01 m/s .. 0.3 m/s",
        "arm.deviceState != Fault",
        "(measured)",
        "may be paused at any time; a tool that presses is then taken off after 2 s",
        "par lead",
    ):
        assert words in text
    assert "The only one in this library" in re.sub("<[^>]*>", "", made()["skill/Align.html"])
    assert 'href="../terms.html#wiping-isClean">isClean</a>' in made()["skill/Wipe.html"]
    assert "Called by" in made()["skill/MoveTo.html"]
    assert re.search(r'<a href="../skill/Push.html"><text [^>]*>with Push</text></a>', made()["skill/Wipe.html"])


def test_another_process_writes_the_same_bytes(tmp_path: Path) -> None:
    command_line = [sys.executable, "-m", "skillc", "doc", str(WIPING), "-o", str(tmp_path)]
    subprocess.run(command_line, check=True, capture_output=True, env={**os.environ, "PYTHONHASHSEED": "7"})
    written = {path.relative_to(tmp_path).as_posix(): path for path in tmp_path.rglob("*.*")}
    assert {path: file.read_text(encoding="utf-8") for path, file in written.items()} == made()


def test_html_and_scripts_of_authors_stay_text(tmp_path: Path) -> None:
    pages = written_from(RANKED, tmp_path)
    page = (pages / "skill/Hold.html").read_text(encoding="utf-8")
    assert "<script>alert" not in page
    assert "&lt;script&gt;" in page
    assert "<em>all</em>" in page
    assert "javascript:" not in "".join(Page(page).links)


def test_the_order_of_implementations_is_explained(tmp_path: Path) -> None:
    page = (written_from(RANKED, tmp_path) / "skill/Hold.html").read_text(encoding="utf-8")
    text = re.sub(r"\s+", " ", re.sub("<[^>]*>", "", page))
    for words in (
        "Tried before narrow, because it is made for fewer cases: gripper: skillc:WsgGripper.",
        "Never competes with other: no gripper fits both.",
        "Tried before first_choice, because it is made for fewer cases",
        "Tried before any_hand, because of prefer 2 against 0.",
        "Tried last.",
    ):
        assert words in text
    assert reasons((), libraries.load_vocabulary()) == ()


def test_pages_of_skills_that_are_gone_go_and_other_files_stay(tmp_path: Path) -> None:
    pages = written_from(RANKED, tmp_path)
    (pages / "skill/mine.html").write_text("<p>mine", encoding="utf-8")
    written_from(RANKED.replace("Hold", "Keep"), tmp_path)
    assert {path.name for path in (pages / "skill").iterdir()} == {"Keep.html", "mine.html"}


def written_from(text: str, folder: Path) -> Path:
    (folder / "library.skill").write_text(text, encoding="utf-8")
    done = CliRunner().invoke(command, [str(folder), "-o", str(folder / "out")])
    assert done.exit_code == 0, done.output
    return folder / "out"


def test_headings_in_documentation_come_below_those_of_the_page() -> None:
    assert "<h3>Note</h3>" in prose.block("# Note\n\ntext")


@pytest.mark.parametrize("scheme", [0, 1])
@pytest.mark.parametrize("ground", ["ground", "field", "mark"])
@pytest.mark.parametrize("ink", ["text", "faint", "link", "keyword", "value"])
def test_text_stands_out_from_its_ground(scheme: int, ground: str, ink: str) -> None:
    rules = re.findall(r":root \{(.*?)\}", made()["style.css"], re.DOTALL)
    colours = dict(re.findall(r"--(\w+): (#[0-9a-f]{6})", rules[scheme]))
    lighter, darker = sorted((_luminance(colours[ground]), _luminance(colours[ink])), reverse=True)
    assert (lighter + 0.05) / (darker + 0.05) >= 4.5


def _luminance(colour: str) -> float:
    """Return the relative luminance, as the accessibility guidelines define it."""
    channels = [int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)]
    linear = [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in channels]
    return sum(share * value for share, value in zip((0.2126, 0.7152, 0.0722), linear, strict=True))
