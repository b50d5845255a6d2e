"""HermiT, a reasoner for OWL 2 DL, on what was printed; it runs in Java."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
from rdflib import Graph

needs_java = pytest.mark.skipif(shutil.which("java") is None, reason="the reasoner runs in Java")


def classified(texts: Iterable[str]) -> Any:
    """Return a world with all that follows from Turtle texts together; an error where they contradict each other."""
    import owlready2

    together = Graph()
    for text in texts:
        together.parse(data=text, format="turtle")
    world = owlready2.World()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "all.nt"
        together.serialize(file, format="nt", encoding="utf-8")
        with world.get_ontology(file.as_uri()).load():
            owlready2.sync_reasoner(world, debug=0)
    return world
