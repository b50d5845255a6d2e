"""The page on projects: its manifest is one, its table has every key, and its commands exist."""

from __future__ import annotations

import re

import msgspec

from docs.pages import ROOT, blocks
from skillc.cli.main import skillc
from skillc.services.project.manifest import Manifest, ToolSettings, read_manifest
from skillc.services.scaffolding.project_templates import TEMPLATES
from skillc_dsl.source import Source

PAGE = ROOT / "docs/projects.md"


def test_the_example_is_a_manifest_with_every_key() -> None:
    example = next(block.text for block in blocks(PAGE) if block.language == "toml")
    outcome = read_manifest(Source("skillc.toml", example))
    assert outcome.diagnostics == () and outcome.value is not None
    unused = {
        field.name
        for field in msgspec.structs.fields(Manifest)
        if field.name != "tool" and getattr(outcome.value, field.name) in (None, (), {})
    }
    assert unused == set()


def test_every_key_has_a_row() -> None:
    table = PAGE.read_text("utf-8").partition("## Keys")[2].partition("##")[0]
    rows = re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
    keys = {key.partition(".NAME")[0] for row in rows for key in re.findall(r"`([^`]+)`", row)}
    tools = {f"tool.{field.name}" for field in msgspec.structs.fields(ToolSettings)}
    assert keys == ({field.name for field in msgspec.structs.fields(Manifest)} - {"tool"}) | tools


def test_every_template_has_a_row() -> None:
    table = PAGE.read_text("utf-8").partition("## Templates")[2].partition("##")[0]
    assert re.findall(r"^\| `(.*?)` \|", table, re.MULTILINE) == [each.name for each in TEMPLATES]


def test_the_commands_exist() -> None:
    named = set(re.findall(r"^skillc (\w+)", PAGE.read_text("utf-8"), re.MULTILINE))
    assert len(named) > 4
    assert named <= set(skillc.commands or skillc.list_commands(None))  # type: ignore[attr-defined]
