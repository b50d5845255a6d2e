"""Collects the pages, those that are made from the code included, and has Zensical make the site of them."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from skillc_site.commands import command_page
from skillc_site.layout import prepare_page
from skillc_site.navigation import OVERVIEW, Section, find_pages, read_sections, toml_of
from skillc_site.python_modules import MODULE_PAGES
from skillc_site.repository import ROOT, Links
from skillc_site.vocabulary import vocabulary_page

HERE = Path(__file__).parent
DOCS = HERE.parent
MADE = {"commands.md": command_page, "vocabulary.md": vocabulary_page, **MODULE_PAGES}
"""Pages that are made from the code, each with the function that returns its Markdown."""
MADE_TITLES = (("The command line", "commands.md"), ("The vocabulary", "vocabulary.md"))
REFERENCE = "Reference"
"""The section after which the reference of the Python API comes."""
MODULE_TITLES = tuple((name.removesuffix(".md"), name) for name in MODULE_PAGES)
SOURCES = ("dsl", "ontology", "compiler", "runtime", "app")
"""The folders of the packages that the reference of the Python API is made from."""
SEARCH = "search-in-folder.js"
FOREIGN_SEARCH = "https://unpkg.com/iframe-worker/shim"
"""The script that Zensical names for pages that are opened from a folder; it would be loaded from elsewhere."""
STATIC = (".svg", ".png", ".webp", ".gif", ".jpg")
ALSO = {"index.md": "README.md", "editors.md": "editors/README.md", "contributing.md": "CONTRIBUTING.md"}
ALSO |= {"changelog.md": "CHANGELOG.md"}
"""Pages of the site that stand elsewhere in the repository."""


def build_site(out: Path) -> int:
    """Build the site into the folder `out`, which is emptied first; return 0, or 1 if anything was reported."""
    read = read_sections(DOCS / "README.md", {REFERENCE: MADE_TITLES})
    place = [each.title for each in read].index(REFERENCE) + 1
    sections = (*read[:place], Section("Python API", MODULE_TITLES), *read[place:])
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder)
        missing = write_pages(project / "docs")
        (project / "zensical.toml").write_text(_settings(sections), encoding="utf-8")
        for name in ("site.css", SEARCH):
            shutil.copy(HERE / name, project / "docs" / name)
        code = run_zensical(project)
        if missing:
            sys.stderr.write("\n".join(missing) + "\n")
            code = 1
        if code == 0:
            use_own_search(project / "site")
            shutil.rmtree(out, ignore_errors=True)
            shutil.copytree(project / "site", out)
            sys.stderr.write(f"{out / 'index.html'}\n")
    return code


def write_pages(folder: Path) -> list[str]:
    """Write all Markdown pages of the site, and the pictures, into a folder; return sentences about wrong links."""
    found = {OVERVIEW if name == "README.md" else name: DOCS / name for name in find_pages(DOCS)}
    texts = {name: (path, path.read_text("utf-8")) for name, path in found.items()}
    texts |= {name: (ROOT / path, (ROOT / path).read_text("utf-8")) for name, path in ALSO.items()}
    texts |= {name: (DOCS / name, make()) for name, make in MADE.items()}
    links = Links({path: name for name, (path, _) in texts.items()})
    pages = {name: prepare_page(links.rewrite(text, path, name)) for name, (path, text) in texts.items()}
    pages |= links.linked_files()
    _write(pages, folder)
    for path in sorted(DOCS.rglob("*")):
        if path.suffix in STATIC:
            _copy(path, folder / path.relative_to(DOCS))
    return links.missing


def run_zensical(project: Path) -> int:
    """Build the project in its folder; print what it reports, return 1 if it reports anything."""
    command = [sys.executable, "-m", "zensical", "build", "--clean", "--strict"]
    ran = subprocess.run(command, cwd=project, capture_output=True, text=True, check=False)
    if ran.returncode or "Warning" in ran.stdout + ran.stderr:
        sys.stderr.write(ran.stdout + ran.stderr.partition("Traceback")[0])
        return 1
    return 0


def use_own_search(site: Path) -> None:
    """Let the pages of a built site load the script for the search in a folder from the site itself."""
    for page in site.rglob("*.html"):
        text = page.read_text("utf-8")
        script = "../" * (len(page.relative_to(site).parts) - 1) + SEARCH
        page.write_text(text.replace(FOREIGN_SEARCH, script), encoding="utf-8")


def _settings(sections: tuple[Section, ...]) -> str:
    """Return zensical.toml with the navigation and the folders of the packages."""
    text = (HERE / "zensical.toml").read_text("utf-8").replace("nav = []", f"nav = {toml_of(sections)}")
    return text.replace("paths = []", f"paths = {json.dumps([str(ROOT / each) for each in SOURCES])}")


def _write(pages: Mapping[str, str], folder: Path) -> None:
    for name, text in pages.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def _copy(path: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(path, target)
