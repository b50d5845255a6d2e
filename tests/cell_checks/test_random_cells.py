"""A cell that was built with margins has no problem; the same cell, spoilt in one way, has exactly this one."""

from __future__ import annotations

import re
from pathlib import Path
from random import Random

import pytest

from cell_checks.random_cells import HEAD, SPOILED, random_cell
from skillc.services.cell_checks.report import cell_diagnostics
from skillc.services.library import libraries
from skillc_dsl.diagnostics import Diagnostic
from skillc_runtime.scene.load import read_scene


def problems(text: str, folder: Path, *used: str) -> list[Diagnostic]:
    """Return what is wrong in a cell, `used` by a task; its scene has no other problem."""
    path = folder / "cell.ttl"
    path.write_text(text, "utf-8")
    scene = read_scene(path, libraries.load_vocabulary())
    assert scene.problems == ()
    return list(cell_diagnostics(scene, str(path), frozenset(f"http://example.org/lab#{name}" for name in used)))


@pytest.mark.parametrize("seed", range(6))
def test_a_cell_with_margins_has_no_problem(seed: int, tmp_path: Path) -> None:
    text = str(random_cell(Random(seed)))
    assert "lab:Part-0" in text
    assert problems(text, tmp_path, "Part-0", "Bin-0") == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("way", SPOILED)
def test_a_spoilt_cell_has_exactly_this_problem(way: str, seed: int, tmp_path: Path) -> None:
    random = Random(seed)
    cell, part = random_cell(random).spoilt(SPOILED[way], random)
    (found,) = problems(str(cell), tmp_path)
    assert way.startswith(found.name)
    assert re.search(rf"lab:{part}\b", found.message)
    statement = str(cell).splitlines()[: found.span.line]
    assert [line for line in statement if line.startswith("lab:")][-1].startswith(f"lab:{part} ")
    assert found.help


@pytest.mark.parametrize(("stated", "depths_mm"), [("", [400]), ("lab:Table skiros:hasA lab:Rack .", [])])
def test_furniture_in_furniture_is_told_with_both_unless_one_is_stated_to_be_a_part(
    stated: str, depths_mm: list[int], tmp_path: Path
) -> None:
    rack = "lab:Rack a skillc:Furniture ; skillc:on lab:Floor ; skillc:atX 0.5 ; skillc:atY 0.4 ;\n"
    rack += "    skiros:SizeX 0.2 ; skiros:SizeY 0.6 ; skiros:SizeZ 0.4 .\n"
    found = problems(HEAD + rack + stated, tmp_path)
    assert [(each.name, each.severity) for each in found] == [("inside-another", "warning")] * len(depths_mm)
    for each, depth_mm in zip(found, depths_mm, strict=True):
        assert f"lab:Rack is {depth_mm} mm inside lab:Table" in each.message
        assert len(each.labels) == 1
