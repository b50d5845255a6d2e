"""Which parameters can be learned, and what values of them are tried and written."""

from __future__ import annotations

from functools import cache

import pytest

from learning.runners import RADIUS, SPEED, parameter
from skillc.errors import RequestError
from skillc.services.learning.parameters import Learnable, choose_learnable, find_learnable
from skillc.services.learning.text import MARK, LearnedValue, change_texts
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.trials.settings import Setting, apply_settings
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.reasons import ParameterReason


@cache
def shipped() -> tuple[LibraryFiles, SkillLibrary]:
    files = find_library(SHIPPED / "wiping")
    return files, compile_valid(files)


def chosen(implementation: str, *defaults: str) -> ImplementationChosen:
    """Return that a call began, and which parameters had their defaults."""
    skill, _, name = implementation.partition(".")
    return ImplementationChosen(
        time=0.0,
        node=1,
        skill=skill,
        implementation=name,
        bindings={},
        determined=tuple(ParameterReason(parameter=each, how="default") for each in defaults),
        source=shipped()[1].implementations[implementation].source,
    )


@cache
def run() -> tuple[ImplementationChosen, ...]:
    """What began in a run."""
    return (
        chosen("Pick.from_above", "speed"),
        chosen("ActuateGripper.robotiq", "force"),
        chosen("TakePosture.joints", "posture", "pace"),
        chosen("Wipe.wipe_lanes", "speed", "radius", "rate"),
        chosen("MoveLinear.line"),
        chosen("Push.guarded", "travel", "approach"),
        chosen("Pick.from_above", "speed"),
    )


def find() -> tuple[Learnable, ...]:
    files, library = shipped()
    return find_learnable(library, files, run())


def test_what_can_be_learned_has_a_range_and_had_its_default() -> None:
    found = {each.name: (each.low, each.default, each.high, each.unit, each.type) for each in find()}
    assert found == {
        "Pick.from_above.speed": (0.01, 0.1, 0.25, "m/s", "Speed"),
        "ActuateGripper.robotiq.force": (30.0, 30.0, 70.0, "N", "Force"),
        "TakePosture.joints.pace": (0.01, 0.25, 1.0, "", "Number"),
        "Wipe.wipe_lanes.speed": (0.01, 0.1, 0.3, "m/s", "Speed"),
        "Wipe.wipe_lanes.radius": (0.0, 15.0, 50.0, "mm", "Length"),
        "Wipe.wipe_lanes.rate": (0.1, 1.0, 3.0, "Hz", "Frequency"),
        "Push.guarded.travel": (1.0, 12.0, 30.0, "cm", "Length"),
        "Push.guarded.approach": (0.5, 5.0, 10.0, "cm/s", "Speed"),
    }


@pytest.mark.parametrize(
    ("asked", "names"),
    [
        ((), ["Wipe.wipe_lanes.speed", "Wipe.wipe_lanes.radius", "Wipe.wipe_lanes.rate"]),
        (("rate", "Pick.speed"), ["Wipe.wipe_lanes.rate", "Pick.from_above.speed"]),
        (("wipe_lanes.speed", "Wipe.wipe_lanes.speed"), ["Wipe.wipe_lanes.speed"]),
    ],
)
def test_parameters_are_chosen_by_name(asked: tuple[str, ...], names: list[str]) -> None:
    assert [each.name for each in choose_learnable(find(), asked, shipped()[0])] == names


@pytest.mark.parametrize(
    ("asked", "why"),
    [
        (("speed",), "`speed` may be `Pick.from_above.speed` or `Wipe.wipe_lanes.speed`: name one of them"),
        (("sped",), "`sped` is no parameter that can be learned here; there are `Pick.from_above.speed`"),
        (("Wipe",), "`Wipe` is no parameter"),
    ],
)
def test_a_name_that_fits_none_or_several_is_an_error(asked: tuple[str, ...], why: str) -> None:
    with pytest.raises(RequestError) as error:
        choose_learnable(find(), asked, shipped()[0])
    assert why in str(error.value)


def test_a_task_that_uses_no_defaults_of_its_library_says_so() -> None:
    files = shipped()[0]
    with pytest.raises(
        RequestError, match="no defaults of implementations of its own library; name parameters of others"
    ):
        choose_learnable(find()[:2], (), files)
    with pytest.raises(RequestError, match="the task uses the default of no parameter with a range"):
        choose_learnable((), (), files)


@pytest.mark.parametrize(
    ("of", "drawn", "written", "si"),
    [
        (SPEED, 0.123456, "0.123 m/s", 0.123),
        (RADIUS, 7.0049, "7 mm", 0.007),
        (RADIUS, 0.0123456, "0.0123 mm", 0.0000123),
        (SPEED, 0.29999, "0.3 m/s", 0.3),
        (SPEED, 0.00999, "0.01 m/s", 0.01),
        (parameter("count", 1, 5000, 10, kind="Int"), 1234, "1230", 1230),
        (parameter("share", 0, 1, 0.5), 1e-5, "0.00001", 1e-5),
    ],
)
def test_what_is_tried_is_what_is_written(of: Learnable, drawn: float, written: str, si: float) -> None:
    value = of.round(drawn)
    assert of.write(value) == written
    assert of.set_to(value) == Setting(of.implementation, of.parameter, si)


def test_ranges_of_a_decade_are_logarithmic() -> None:
    assert [each.is_logarithmic for each in (SPEED, RADIUS, parameter("rate", 0.1, 1.0, 0.5))] == [True, False, True]
    assert not parameter("force", 2.0, 10.0, 5.0).is_logarithmic


def test_settings_change_defaults_of_one_implementation() -> None:
    library = shipped()[1]
    changed = apply_settings(library, [Setting("Wipe.wipe_lanes", "speed", 0.2)])
    assert changed.implementations.keys() == library.implementations.keys()
    different = [name for name, each in changed.implementations.items() if each != library.implementations[name]]
    assert different == ["Wipe.wipe_lanes"]
    with pytest.raises(KeyError):
        apply_settings(library, [Setting("Wipe.wipe_lanes", "sped", 0.2)])


def test_a_shared_implementation_is_changed_in_its_own_file() -> None:
    files, library = shipped()
    approach = next(each for each in find() if each.parameter == "approach")
    (changed,) = change_texts(files, library, [LearnedValue(approach, 6.2)], [f"{MARK}for clean_table."])
    assert changed.path == SHIPPED / "std/compliance.skill"
    assert "refine approach: Speed = 6.2 cm/s" in " ".join(changed.after.split())
