"""The change log is short, and the page on versions has the formats and the editions of the code."""

from __future__ import annotations

import re
import tomllib

from docs.pages import ROOT
from skillc.cells.journal.schema import SCHEMA as JOURNAL
from skillc.server.state import SCHEMA as STATE
from skillc.services.learning.study import FORMAT as STUDY
from skillc.services.library.schemas import DIAGNOSTICS_FORMAT, PROJECT_FORMAT, RESULT_FORMAT
from skillc_compiler.resolve.type_names import LATER
from skillc_dsl.editions import EDITIONS
from skillc_dsl.token_table import SINCE
from skillc_model.skills import FORMAT as LIBRARY
from skillc_runtime.evaluation.trials.journal import FORMAT as TRIALS
from skillc_runtime.planning.cache import FORMAT as PLANS
from skillc_runtime.recording.events import FORMAT as EVENTS
from skillc_runtime.recording.mcap.signal_block import FORMAT as BLOCKS
from skillc_runtime.recording.signals.files import FORMAT as SIGNALS
from skillc_runtime.store.disk import FORMAT as STORE

CHANGES = (ROOT / "CHANGELOG.md").read_text("utf-8")
MOST_LINES = 30
FORMATS = {
    "`library.json`": LIBRARY,
    "events": EVENTS,
    "signals of a recording": BLOCKS,
    "the history of a cell": JOURNAL.format,
    "the state of a server": STATE.format,
    "a store in a folder": int(STORE.split()[-1]),
    "trials in a folder": TRIALS,
    "a study of": STUDY,
    "plans in the cache": PLANS,
    "`result.json`": RESULT_FORMAT,
    "`skillc check --json`, `skillc.toml`, `signals.json`": DIAGNOSTICS_FORMAT,
}


def _sections() -> dict[str, list[str]]:
    parts = re.split(r"^## (.*)$", CHANGES, flags=re.MULTILINE)[1:]
    return {
        name: [each for each in text.splitlines() if each] for name, text in zip(parts[::2], parts[1::2], strict=True)
    }


def test_a_section_of_the_change_log_has_at_most_thirty_lines() -> None:
    sections = _sections()
    assert {name: len(lines) for name, lines in sections.items() if len(lines) > MOST_LINES} == {}


def test_the_newest_release_of_the_change_log_is_the_version_of_the_package() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["version"]
    assert list(_sections())[:2] == ["Unreleased", version]
    assert f"to {version}" in (ROOT / "docs/upgrade.md").read_text("utf-8")


def test_the_page_on_versions_has_the_formats_of_the_code() -> None:
    page = (ROOT / "docs/versions.md").read_text("utf-8")
    rows = re.findall(r"^\| (.*?) \| (\d+) \|", page, re.MULTILINE)
    told = {name: int(number) for start, number in rows for name in FORMATS if start.startswith(name)}
    assert len(rows) == len(FORMATS) and told == FORMATS
    assert DIAGNOSTICS_FORMAT == PROJECT_FORMAT == SIGNALS


def test_the_page_on_projects_names_the_words_of_editions() -> None:
    page = (ROOT / "docs/projects.md").read_text("utf-8")
    for edition in EDITIONS[1:]:
        (listed,) = re.findall(
            rf"^With edition {edition} came the words (.*?), the terms", page, re.MULTILINE | re.DOTALL
        )
        assert set(re.findall(r"`(\w+)`", listed)) == {word for word, since in SINCE.items() if since == edition}


def test_the_page_on_projects_names_the_types_that_came_later() -> None:
    page = (ROOT / "docs/projects.md").read_text("utf-8")
    (listed,) = re.findall(r"the types (.*?), and the skills", page, re.DOTALL)
    assert set(re.findall(r"`(\w+)`", listed)) == LATER


def test_the_page_on_projects_names_the_editions() -> None:
    (row,) = re.findall(r"^\| `edition` \|.*$", (ROOT / "docs/projects.md").read_text("utf-8"), re.MULTILINE)
    assert " and ".join(map(str, EDITIONS)) in row.replace(" or ", " and ")
