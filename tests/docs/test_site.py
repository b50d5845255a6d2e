"""The site of the documentation: complete, without warnings, and readable without a network."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import pytest

from docs.pages import ROOT
from skillc.cli.main import COMMANDS
from skillc_site.build import build_site, run_zensical
from skillc_site.diagrams import draw_flowchart
from skillc_site.layout import prepare_page
from skillc_site.navigation import find_pages, read_sections
from skillc_site.python_modules import MODULES
from skillc_site.repository import Links

pytestmark = pytest.mark.slow

LOADED = re.compile(r"""<(?:script|img|link rel="stylesheet"|iframe|source)[^>]*?(?:src|href)="(https?:[^"]*)""")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("site")
    assert build_site(out) == 0
    return out


def test_every_page_is_listed_once() -> None:
    listed = [path for section in read_sections(ROOT / "docs/README.md", {}) for _, path in section.pages]
    assert sorted(set(listed)) == sorted(listed)
    assert set(find_pages(ROOT / "docs")) - {"README.md"} <= set(listed)


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 30
    assert {page.name: LOADED.findall(page.read_text("utf-8")) for page in pages} == {page.name: [] for page in pages}
    assert (site / "search-in-folder.js").is_file()


def test_skills_are_highlighted_and_charts_are_drawn(site: Path) -> None:
    assert '<span class="kd">skill</span>' in (site / "language.html").read_text("utf-8")
    assert "WorldState</tspan>" in (site / "architecture.html").read_text("utf-8")


def test_the_command_line_and_the_vocabulary_are_complete(site: Path) -> None:
    commands = (site / "commands.html").read_text("utf-8")
    names = [path.stem for path in COMMANDS.glob("[a-z]*.py")]
    assert len(names) > 20
    assert [name for name in names if f'id="skillc-{name}"' not in commands] == []
    assert re.search(r"<p>The arm of a FILE has its kinematics", commands), "later paragraphs of a help are prose"
    assert "<code>isClean</code>" in (site / "vocabulary.html").read_text("utf-8")


def test_the_public_modules_are_those_that_the_page_on_python_lists() -> None:
    listed = re.findall(r"^\| `(skillc\.\w+)` \|", (ROOT / "docs/python.md").read_text("utf-8"), re.MULTILINE)
    assert sorted(["skillc", *listed]) == sorted(MODULES)


def test_every_public_name_of_python_has_its_place(site: Path) -> None:
    for name in MODULES:
        page = (site / f"{name}.html").read_text("utf-8")
        exported = importlib.import_module(name).__all__
        assert [each for each in exported if f'id="{name}.{each}"' not in page] == []
    assert "Plan for a task, or for a goal in a scene, without running it." in (site / "skillc.html").read_text("utf-8")


@pytest.mark.parametrize(
    ("text", "code"),
    [("# A\n\n[here](#a)\n", 0), ("# A\n\n[away](#b)\n", 1), ("# A\n\n[page](b.md)\n", 1)],
    ids=["right", "no such anchor", "no such page"],
)
def test_wrong_links_are_reported(text: str, code: int, tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs/index.md").write_text(text)
    (tmp_path / "zensical.toml").write_text('[project]\nsite_name = "a"\n')
    assert run_zensical(tmp_path) == code


def test_links_to_files_become_pages() -> None:
    links = Links({ROOT / "docs/scenes.md": "scenes.md"})
    text = "[a](scenes.md#x) [b](../pyproject.toml) [c](none.md) [d](https://example.org)\n```text\n[e](none.md)\n```\n"
    expected = text.replace("../pyproject.toml", "../files/pyproject.toml.md").replace("scenes.md", "../scenes.md")
    assert (
        links.rewrite(
            text.replace("scenes.md", "../scenes.md").replace("../py", "../../py"),
            ROOT / "docs/how-to/a.md",
            "how-to/a.md",
        )
        == expected
    )
    assert [sentence.split("'")[1] for sentence in links.missing] == ["none.md"]
    assert list(links.linked_files()) == ["files/pyproject.toml.md"]


def test_pages_are_laid_out_for_the_site() -> None:
    page = "Text\n- item\n\n```turtle cell.ttl\nText\n- item\n```\n"
    assert prepare_page(page) == 'Text\n\n- item\n\n``` turtle title="cell.ttl"\nText\n- item\n```\n'


def test_a_chart_that_cannot_be_drawn_is_refused() -> None:
    assert draw_flowchart('flowchart LR\n    a["x < y"] -->|to| b["z"]\n').count("<rect") == 2
    with pytest.raises(ValueError, match="a --- b"):
        draw_flowchart("flowchart LR\n    a --- b\n")
