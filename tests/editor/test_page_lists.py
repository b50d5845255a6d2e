"""The page of the studio has the words of the language, and names each package in it with its licence."""

from __future__ import annotations

import json
import re

from docs.pages import ROOT
from skillc_dsl.token_table import KEYWORDS, TYPES

STUDIO = ROOT / "studio"


def find_words(name: str) -> set[str]:
    """Return the texts in a list of `keywords.ts`."""
    text = (STUDIO / "src/editor/keywords.ts").read_text("utf-8")
    listed = re.search(rf"const {name}: [^=]*= new Set\(\[(.*?)\]\)", text, re.DOTALL)
    assert listed is not None
    return set(re.findall(r'"([^"]*)"', listed.group(1)))


def test_its_words_are_those_of_the_language() -> None:
    assert find_words("KEYWORDS") == {word for words in KEYWORDS.values() for word in words}
    assert find_words("TYPES") == set(TYPES)


def test_each_package_in_it_is_named_with_its_licence() -> None:
    package = json.loads((STUDIO / "package.json").read_text("utf-8"))
    named = (STUDIO / "src/views/licences.ts").read_text("utf-8")
    for each in package["dependencies"]:
        group = each.partition("/")[0] + "/*"
        assert re.search(rf"[(\s]{re.escape(each)}[,)]", named) or f"{group}" in named, each
