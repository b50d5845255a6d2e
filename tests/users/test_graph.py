"""`skillc graph`: everything is drawn in the author's words, nothing overflows or overlaps."""

from __future__ import annotations

from itertools import combinations, pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from skillc.cli.commands.graph import command
from skillc_compiler.emit.picture import mermaid, svg
from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_compiler.emit.picture.drawing import list_drawable, make_picture
from skillc_compiler.emit.picture.layout import PlacedBox, lay_out
from skillc_compiler.emit.picture.text import draw
from skillc_compiler.emit.picture.wrapping import count_cells, wrap_text
from skillc_compiler.resolve.files import read_sources
from skillc_dsl.source import Source

HERE = Path(__file__).parent / "every_node.skill"
FILES = read_sources([Source("every_node.skill", HERE.read_text(encoding="utf-8"))], {}, "users").value
WORDS = {
    *("reactive seq", "reactive sel", "sel", "par any", "par all", "par race", "par lead", "try", "invert", "once"),
    *("retry 3", "repeat 2", "timeout", "if", "then", "else", "while", "for", "wait", "wait until", "check", "fail"),
    *("TakePosture[joints]", "with Compliance", "skill Everything", "impl all_of_it of Everything"),
}
TEXT = "{http://www.w3.org/2000/svg}text"
WIDEST_FONT = 0.62 * 12


def everything() -> PictureBox:
    box = make_picture("Everything", FILES)
    assert box is not None
    return box


def titles(box: PictureBox) -> list[str]:
    return [box.title, *(title for child in box.children for title in titles(child))]


def test_every_node_is_drawn() -> None:
    assert set(titles(everything())) >= WORDS


def test_text_is_the_authors() -> None:
    texts = "".join(ElementTree.fromstring(svg.draw_document(everything())).itertext())
    for words in ('arm, posture: "<home> & `日本語`"', "pose in corners(surface)", "prefer 2", "given force", "20 ms"):
        assert words in texts


@pytest.mark.parametrize("box", [everything(), PictureBox("call", "▶", "x" * 200, ("一二三" * 60, "a b " * 90))])
def test_text_stays_in_its_box_and_boxes_apart(box: PictureBox) -> None:
    placed = lay_out(box)
    root = ElementTree.fromstring(svg.draw_document(box))
    lines = [each for each in root.iter(TEXT) if each.get("class") != "symbol"]
    assert len(lines) == sum(len(each.title) + len(each.lines) for each in placed)
    for line in lines:
        x, y, text = float(line.get("x", 0)), float(line.get("y", 0)), line.text or ""
        assert any(_holds(each, x, y, count_cells(text) * WIDEST_FONT) for each in placed), text
    assert all(one.y + one.height < other.y for one, other in pairwise(placed))
    assert max(each.x + each.width for each in placed) < float(root.get("width", 0))


def _holds(box: PlacedBox, x: float, y: float, width: float) -> bool:
    return box.x <= x and x + width <= box.x + box.width and box.y + 10 <= y <= box.y + box.height - 4


@pytest.mark.parametrize("width", [8, 20, 58])
def test_wrapped_text_loses_nothing(width: int) -> None:
    text = "arm, target: first(lanes(surface, tool, 0.2)), 日本語日本語日本語 " + "y" * 90
    lines = wrap_text(text, width)
    assert max(map(count_cells, lines)) <= width
    assert "".join("".join(lines).split()) == "".join(text.split())
    assert wrap_text("", width) == ("",)


def test_mermaid_escapes_what_it_would_read() -> None:
    text = mermaid.draw(everything())
    labels = [line.split('["', 1)[1].removesuffix('"]') for line in text.splitlines() if '["' in line]
    assert len(labels) == len(titles(everything()))
    assert not any(set('"`&') & set(label) for label in labels)
    names = [line.split("[")[0].strip() for line in text.splitlines() if '["' in line]
    assert not any(one == other for one, other in combinations(names, 2))
    assert text.count("-->") == len(labels) - 1


def test_a_task_shows_its_scene_and_goal() -> None:
    box = make_picture("everything", FILES)
    assert box is not None
    assert box.lines == ('scene "iiwa_table.ttl"',)
    assert box.children[0].lines == ("exists surface: Surface (surface.located == true)",)
    assert list_drawable(FILES) == ("Everything", "Locate", "everything")


def test_a_name_stays_with_its_value() -> None:
    assert wrap_text("arm: lab:Arm-1, to: lab:Dock", 20) == ("arm: lab:Arm-1,", "  to: lab:Dock")


def test_a_wrapped_title_goes_on_indented() -> None:
    box = PictureBox("call", "▶", "Approach the surface of the bench", ("with the tool",))
    assert draw(box, 26) == "▶ Approach the surface\n    of the bench\n  with the tool\n"


def test_the_plan_of_a_task_is_drawn() -> None:
    drawn = CliRunner().invoke(command, ["wiping", "clean_table", "--plan", "--format", "mermaid"])
    assert drawn.exit_code == 0, drawn.output
    assert drawn.stdout.index("▶ Pick") < drawn.stdout.index("▶ Wipe")
    unplanned = CliRunner().invoke(command, [str(HERE), "Everything", "--plan"])
    assert unplanned.exit_code == 2


def test_a_goal_out_of_reach_has_no_plan(tmp_path: Path) -> None:
    text = """
use skiros
import "handling.skill"
prefix lab: <http://example.org/lab#>
task swap {
    scene "iiwa_table.ttl"
    goal  lab:Table-1 contain lab:Eraser-1
}
"""
    (tmp_path / "swap.skill").write_text(text, encoding="utf-8")
    refused = CliRunner().invoke(command, [str(tmp_path), "swap", "--plan"])
    assert refused.exit_code == 3, refused.output
    assert "there is no plan" in refused.stderr


def test_python_is_named() -> None:
    box = make_picture("Locate", FILES)
    assert box is not None
    assert box.lines == ("post sensed located: surface.located == true",)
    assert box.children[0].children[0].lines == ("skillc_runtime.primitives.compliance:Align",)


def test_the_command_writes_a_file_and_names_what_exists(tmp_path: Path) -> None:
    runner = CliRunner()
    for file, start in (("a.svg", "<?xml"), ("a.mmd", "flowchart")):
        drawn = runner.invoke(command, [str(HERE), "Everything", "-o", str(tmp_path / file)])
        assert (drawn.exit_code, drawn.stdout) == (0, "")
        assert (tmp_path / file).read_text(encoding="utf-8").startswith(start)
    missing = runner.invoke(command, [str(HERE), "Everythin"])
    assert missing.exit_code == 2
    assert "did you mean `Everything`" in missing.stderr
    nowhere = runner.invoke(command, [str(HERE), "Everything", "-o", str(tmp_path / "a.svg/b.svg")])
    assert nowhere.exit_code == 2
