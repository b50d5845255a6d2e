"""What SkiROS2 says about robots is read by a back end, or said not to be; the table is as code and page are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import skillc_runtime
from skillc.services.library import libraries
from skillc_runtime.scene.checks.unread import NONE, READERS, ROS
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import read_documents, sheet_documents
from skillc_runtime.world.state.terms import SKIROS

ENGINE = Path(skillc_runtime.__path__[0])
HEAD = f"""@prefix lab: <http://example.org/lab#> . @prefix skiros: <{SKIROS}> .
@prefix skillc: <https://w3id.org/skillc/core#> . @prefix ros2: <https://w3id.org/skillc/ros2#> .
lab:Cell a skiros:Scene . lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:iiwa14-sheet ;
    skiros:BaseFrameId "map" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 .
lab:Iiwa-1 skiros:CompliantController "impedance" .
"""
PAGE = Path(__file__).parents[2] / "docs" / "from-skiros2.md"
ROW = re.compile(r"^\| (`skiros:[^|]*) \| ([^|]*) \|", re.MULTILINE)


def notes(said: str) -> list[tuple[str, int, str]]:
    document = Document("scene.ttl", HEAD + said)
    problems = read_documents([document, *sheet_documents()], libraries.load_vocabulary()).problems
    assert all(each.severity == "note" for each in problems), problems
    return [(each.name, each.span.line, each.message) for each in problems]


def test_what_every_back_end_reads_is_no_note() -> None:
    assert notes('lab:Iiwa-1 skiros:DriverAddress "192.168.1.2" ; skiros:FrameId "iiwa" .') == []


def test_what_no_back_end_reads_and_what_one_reads_is_one_note() -> None:
    said = (
        'lab:Iiwa-1 skiros:MotionExe "exe" ;\n skiros:MoveItGroup "arm" ; skiros:MoveItTCPLink "tcp" .\n'
        'lab:Cell skiros:DiscreteReasoner "Spatial" .'
    )
    message = (
        "no back end reads `skiros:DiscreteReasoner`, `skiros:MotionExe`, `skiros:MoveItGroup`; "
        "only the back end ros2 reads `skiros:MoveItTCPLink`"
    )
    assert notes(said) == [("no-effect", 6, message)]


def test_in_a_scene_for_ros_2_what_that_back_end_reads_is_no_note() -> None:
    topics = 'lab:Iiwa-1 ros2:targetPoseTopic "/pose" ; skiros:CartesianStiffnessTopic "/stiffness" ; {} .'
    assert notes(topics.format('skiros:MoveItTCPLink "tcp"')) == []
    (note,) = notes(topics.format('skiros:CartesianGoalAction "/goal"'))
    assert note[2] == "no back end reads `skiros:CartesianGoalAction`"


@pytest.mark.parametrize("name", [name for name, readers in READERS.items() if readers == ROS])
def test_the_back_end_of_the_table_reads_it(name: str) -> None:
    texts = [file.read_text("utf-8") for file in (ENGINE / "backends" / "ros2").glob("*.py")]
    assert any(re.search(rf'(skiros\(|SKIROS \+ )"{name}"', text) for text in texts)


@pytest.mark.parametrize("name", [name for name, readers in READERS.items() if readers == NONE])
def test_what_the_table_says_is_read_by_none_is_in_no_fact_of_the_engine(name: str) -> None:
    files = [file for file in ENGINE.rglob("*.py") if file.name != "unread.py"]
    reading = [file for file in files if re.search(rf'SKIROS \+ "{name}"', file.read_text("utf-8"))]
    assert len(files) > 300 and reading == []


def test_the_page_has_the_table() -> None:
    rows = {
        name: by for names, by in ROW.findall(PAGE.read_text("utf-8")) for name in re.findall(r"skiros:(\w+)", names)
    }
    said = {name: " and ".join(readers) or "no back end" for name, readers in READERS.items()}
    assert {name: by.replace("`", "").replace(", ", " and ") for name, by in rows.items()} == said


def test_the_table_has_all_that_the_vocabulary_says_of_how_arms_are_driven() -> None:
    known = libraries.load_vocabulary().properties
    of_arms = {
        iri.removeprefix(SKIROS)
        for iri, term in known.items()
        if iri.startswith(SKIROS) and any(domain.endswith("#ArmDevice") for domain in term.domains)
    }
    assert of_arms <= READERS.keys() and len(of_arms) >= 8
