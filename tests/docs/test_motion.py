"""The page about motion names skills, parameters, files and facts that there are."""

from __future__ import annotations

import re

from docs.pages import ROOT
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED
from skillc_runtime.world.state.terms import SKILLC

PAGE = (ROOT / "docs/motion.md").read_text(encoding="utf-8")
ROW = re.compile(r"^\| `(Overlay\w+)` \| `([\w/.]+)` \|[^|]*\| (.*) \|$", re.MULTILINE)


def test_the_facts_of_the_page_are_in_the_vocabulary() -> None:
    named = {SKILLC + name for name in re.findall(r"skillc:([a-z]\w+)", PAGE)}
    vocabulary = libraries.load_vocabulary()
    assert len(named) > 7
    assert named <= vocabulary.properties.keys() | vocabulary.relations.keys()


def test_each_overlay_is_where_the_page_says_with_the_parameters_it_says() -> None:
    rows = ROW.findall(PAGE)
    assert len(rows) == 4
    for skill, file, parameters in rows:
        folder = SHIPPED if "/" in file else SHIPPED / "std"
        text = (folder / file).read_text(encoding="utf-8")
        declared = text.split(f"skill {skill} {{")[1].split("}")[0]
        wanted = set(re.findall(r"^ +(?:in|opt) +(\w+):", declared, re.MULTILINE)) - {"arm"}
        assert set(re.findall(r"`(\w+)`", parameters)) == wanted
