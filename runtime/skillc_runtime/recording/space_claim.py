"""What is known of a plan in space: how many of its steps the arms can carry out, and of which that is not known."""

from __future__ import annotations

from math import degrees

import msgspec

from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledPose


class UnseenCall(msgspec.Struct, frozen=True):
    """A call, by the skills around it, of which nobody says what it needs of space, in a step of a plan, from 1."""

    step: int
    what: str


class ChosenPosture(msgspec.Struct, frozen=True):
    """The joints `q` (nv,) in rad with which an arm brings its tool to a pose, in a step of a plan, from 1.

    `base` is where its base stands then; both poses are in the world. None in older recordings.
    """

    step: int
    arm: LabelledIri
    q: tuple[float, ...]
    tool: LabelledPose
    base: LabelledPose | None = None


class StepsApart(msgspec.Struct, frozen=True):
    """Two steps of a plan, from 1, that do not run at the same time: these arms or bases would come into one place."""

    one: int
    other: int
    arms: tuple[str, str]


class StandAt(msgspec.Struct, frozen=True):
    """Where a base stands in a step of a plan, from 1: an arm does not get to its work where the place wants the base.

    x_m, y_m, yaw_rad: in the frame of the place.
    """

    step: int
    robot: LabelledIri
    place: LabelledIri
    x_m: float
    y_m: float
    yaw_rad: float

    @property
    def text(self) -> str:
        """It as a sentence."""
        turned = f", turned by {degrees(self.yaw_rad):.0f} deg" if self.yaw_rad else ""
        at = f"({self.x_m:.2f}, {self.y_m:.2f}) m from {self.place}{turned}"
        return f"step {self.step}: {self.robot} stands at {at}, since an arm does not get to its work from there"


class PlaceAt(msgspec.Struct, frozen=True):
    """Where a thing is put down at a place in a step of a plan, from 1: `at` is its pose as a tool, on a support.

    That is in the frame of the support, which is the place, furniture in it, or a placing pose if it is stated. board:
    of a shelf, 0 for all else. middle_m: of the thing there, in the same frame; None in older recordings.
    """

    step: int
    thing: LabelledIri
    place: LabelledIri
    support: LabelledIri
    at: LabelledPose
    board: int = 0
    stated: bool = False
    middle_m: tuple[float, float, float] | None = None

    @property
    def text(self) -> str:
        """It as a sentence."""
        if self.stated:
            return f"step {self.step}: {self.thing} is put down at {self.support}"
        x_m, y_m, _ = (round(each, 2) + 0.0 for each in self.middle_m or self.at.position_m)
        on = f"board {self.board} of {self.support}" if self.board else f"{self.support}"
        return f"step {self.step}: {self.thing} is put down at ({x_m:.2f}, {y_m:.2f}) m from the middle of {on}"


class ChosenImplementation(msgspec.Struct, frozen=True):
    """With which implementation a step of a plan, from 1, is tried first: after others a later step does not go."""

    step: int
    skill: str
    implementation: str

    @property
    def text(self) -> str:
        """It as a sentence."""
        return (
            f"step {self.step}: {self.skill}[{self.implementation}], since after another way a later step does not go"
        )


class WayAround(msgspec.Struct, frozen=True):
    """The way of a base to a place in a step of a plan, from 1, that is not straight, since something is in that way.

    corners_m: (x, y) in the world. A run looks for its way again, in the same way.
    """

    step: int
    robot: LabelledIri
    place: LabelledIri
    corners_m: tuple[tuple[float, float], ...]
    around: tuple[LabelledIri, ...]

    @property
    def text(self) -> str:
        """It as a sentence."""
        by = " and ".join(f"({x_m:.2f}, {y_m:.2f}) m" for x_m, y_m in self.corners_m)
        around = " and ".join(str(each) for each in self.around)
        return f"step {self.step}: {self.robot} drives to {self.place} by {by}, around {around}"


class SpaceClaim(msgspec.Struct, frozen=True, kw_only=True):
    """How many steps of a plan go in space, of how many, and why the next does not; None if it does or is not known.

    unseen: the calls in these steps that were not looked at. postures: those in which arms bring their tools to poses,
    in the order of the steps, which a run takes as well. apart: the steps that do not run at the same time, since arms
    would meet. stands: where bases stand beside where a place wants them. places: where things are put down, which a
    run does as well. implementations: the steps that are done with another one than the first that goes. ways: those of
    bases that are not straight. stopped: why the look ended before it was through; empty if it was. from_home: whether
    the arms begin at home; else where they were when the plan was made.
    """

    checked: int
    steps: int
    unseen: tuple[UnseenCall, ...] = ()
    postures: tuple[ChosenPosture, ...] = ()
    apart: tuple[StepsApart, ...] = ()
    stands: tuple[StandAt, ...] = ()
    places: tuple[PlaceAt, ...] = ()
    implementations: tuple[ChosenImplementation, ...] = ()
    ways: tuple[WayAround, ...] = ()
    failure: str | None = None
    stopped: str = ""
    from_home: bool = True

    def carry_over(self, steps: int, why: str) -> SpaceClaim:
        """Return what is known of the last so many steps, which go on for a reason: only in which postures.

        Nobody has looked from where the arms are now.
        """
        return SpaceClaim(checked=0, steps=steps, stopped=why, postures=self.postures, from_home=False)

    @property
    def apart_pairs(self) -> frozenset[tuple[int, int]]:
        """The steps that do not run at the same time, by index, the earlier one first."""
        return frozenset((each.one - 1, each.other - 1) for each in self.apart)

    @property
    def way_names(self) -> dict[int, str]:
        """The implementations with which steps are tried first, by the index of the step."""
        return {each.step - 1: each.implementation for each in self.implementations}

    @property
    def summary(self) -> str:
        """The claim as a clause, such as `all 5 checked in space`."""
        if self.stopped:
            return f"not checked in space: {self.stopped}"
        looked = self.checked - len({each.step for each in self.unseen})
        return f"{f'all {self.steps}' if looked == self.steps else f'{looked} of {self.steps}'} checked in space"

    @property
    def text(self) -> str:
        """The claim, with a line for each step that was not looked at or does not go."""
        if self.stopped:
            return self.summary
        begin = "at home" if self.from_home else "where they are"
        lines = [f"{self.summary}: reach, joints, torques, paths, room; the arms begin {begin}"]
        lines += (f"step {each.step}: nobody says what {each.what} needs of space" for each in self.unseen)
        lines += (each.text for each in self.ways)
        lines += (each.text for each in self.stands)
        lines += (each.text for each in self.places)
        lines += (each.text for each in self.implementations)
        lines += (
            f"steps {each.one} and {each.other} do not run at the same time: {' and '.join(each.arms)} would meet"
            for each in self.apart
        )
        if self.failure is not None:
            lines.append(f"step {self.checked + 1} does not go: {self.failure}")
        return "\n".join(lines)
