"""The page of the studio names each package in it with its licence."""

from __future__ import annotations

import json
import re

from docs.pages import ROOT

STUDIO = ROOT / "studio"


def test_each_package_in_it_is_named_with_its_licence() -> None:
    package = json.loads((STUDIO / "package.json").read_text("utf-8"))
    named = (STUDIO / "src/views/licences.ts").read_text("utf-8")
    for each in package["dependencies"]:
        group = each.partition("/")[0] + "/*"
        assert re.search(rf"[(\s]{re.escape(each)}[,)]", named) or f"{group}" in named, each
