"""Finds what SkiROS2 writes about robots and things that nothing here reads, or one back end alone."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.terms import ROS2, SKIROS

NAME = "no-effect"
LISTED = 5
"""The most places that are shown."""
EVERY: Final = ("every back end",)
NONE: Final = ()
ROS: Final = ("ros2",)
READERS: Final[Mapping[str, tuple[str, ...]]] = {
    "FrameId": EVERY,
    "BaseFrameId": EVERY,
    "CompliantController": EVERY,
    "DriverAddress": ("franka", "ur"),
    "LinkedToFrameId": ROS,
    "JointConfigurationController": ROS,
    "CartesianStiffnessTopic": ROS,
    "CartesianWrenchTopic": ROS,
    "MoveItTCPLink": ROS,
    "CartesianGoalAction": NONE,
    "MotionExe": NONE,
    "OverlayMotionService": NONE,
    "MoveItGroup": NONE,
    "MoveItReferenceFrame": NONE,
    "DiscreteReasoner": NONE,
    "SkillMgr": NONE,
    "CadModel": NONE,
    "PublishTf": NONE,
    "PushToFrameId": NONE,
}
"""Which back ends read what a SkiROS2 scene says about how robots are driven and who looks after things."""


def check_unread(written: Iterable[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield, once for each file, a note with the properties that no back end reads, or `ros2` alone.

    Those that `ros2` reads are not in it if the file has terms of this back end, nor is the address of a device.
    """
    files: dict[str, dict[str, Span]] = defaultdict(dict)
    for_ros = set[str]()
    for each in written:
        if READERS.get(each.predicate.removeprefix(SKIROS)) in (NONE, ROS):
            files[each.lines.path].setdefault(each.predicate, each.predicate_place)
        elif each.predicate.startswith(ROS2):
            for_ros.add(each.lines.path)
    for path, found in files.items():
        unread = {each: at for each, at in found.items() if not (path in for_ros and _readers(each) == ROS)}
        if unread:
            yield _note(unread, vocabulary)


def _note(unread: Mapping[str, Span], vocabulary: Vocabulary) -> Diagnostic:
    groups: dict[tuple[str, ...], list[str]] = defaultdict(list)
    for predicate in sorted(unread):
        groups[_readers(predicate)].append(f"`{vocabulary.short(predicate)}`")
    words = {NONE: "no back end reads", ROS: "only the back end ros2 reads"}
    said = "; ".join(f"{words[readers]} {', '.join(names)}" for readers, names in sorted(groups.items()))
    first, *others = sorted(unread.values())
    help_ = "skills may read them; the page on SkiROS2 says what takes the place of each"
    labels = tuple(Label(place, "also this") for place in others[:LISTED])
    return Diagnostic(NAME, first, said, help_, "note", labels)


def _readers(predicate: str) -> tuple[str, ...]:
    return READERS[predicate.removeprefix(SKIROS)]
