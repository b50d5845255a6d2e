"""The condition of the devices of a cell, and what they measure beside the scene, as lines for a terminal."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from skillc.cli.layout import Row, Style, TableCell, TerminalPage
from skillc_runtime.devices.observed import ObservedArm, ObservedBase, ObservedCell, ObservedGripper

CONDITIONS = {
    "ready": "ready",
    "in-control": "in control",
    "not-in-control": "somebody else has control",
    "wrong-mode": "wrong mode",
    "protective-stop": "protective stop",
    "emergency-stop": "emergency stop",
    "lost": "does not answer",
}


def format_cell(cell: ObservedCell, page: TerminalPage) -> list[str]:
    """Return the lines about all devices of a cell."""
    lines: list[str] = []
    for arm in cell.arms:
        lines += [*_format_arm(arm, page), ""]
    rows = [*map(_gripper_row, cell.grippers), *map(_base_row, cell.bases)]
    lines += page.columns(rows)
    for fault in cell.faults:
        lines += page.wrap(fault, "bad", hanging="  ")
    return lines if lines and lines[-1] else lines[:-1]


def _format_arm(arm: ObservedArm, page: TerminalPage) -> Iterator[str]:
    style: Style = "good" if arm.is_ready else "bad"
    condition = page.paint(CONDITIONS.get(arm.condition, arm.condition), style)
    yield f"{page.paint(arm.arm, 'strong')}  {condition}  {1.0 / arm.period_s:.0f} Hz, {arm.lost} cycles lost"
    if arm.sentence:
        yield from page.wrap(arm.sentence, style, "  ")
    header = ("", "measured", "home", "")
    joints = [
        (f"  {each.joint}", _angle(each.measured_rad), f"{_angle(each.scene_rad)} rad", _differs(each.differs))
        for each in arm.joints
    ]
    away_mm = 1e3 * sum((a - b) ** 2 for a, b in zip(arm.tool_m, arm.scene_tool_m, strict=True)) ** 0.5
    yield from page.table(header, joints, right=(1, 2))
    yield f"  tool    ({_numbers(arm.tool_m, 3)}) m, {away_mm:.0f} mm from where it is at home"
    felt = "not measured" if arm.force_n is None else f"({_numbers(arm.force_n, 1)}) N, in the world"
    yield f"  force   {felt}"
    for remark in filter(None, (arm.felt, *arm.remarks)):
        yield from page.wrap(remark, "warning", "  ", "    ")


def _gripper_row(gripper: ObservedGripper) -> Row:
    blocked = ", something is between its fingers" if gripper.blocked else ""
    opening = f"{1e3 * gripper.opening_m:.1f} mm open, {1e3 * gripper.scene_opening_m:.1f} mm in the scene{blocked}"
    return (TableCell(gripper.gripper, "strong"), opening)


def _base_row(base: ObservedBase) -> Row:
    here, there = (f"({x:.2f}, {y:.2f}) m, {degrees(turn):.0f} deg" for x, y, turn in (base.place, base.scene_place))
    remarks = "".join(f": {each}" for each in base.remarks)
    return (
        TableCell(base.base, "strong"),
        TableCell(f"at {here}; in the scene at {there}{remarks}", _differs_style(base)),
    )


def _differs_style(base: ObservedBase) -> Style:
    return "warning" if base.remarks else ""


def _differs(differs: bool) -> TableCell:
    return TableCell("differs", "warning") if differs else TableCell("")


def _angle(angle_rad: float) -> str:
    return f"{round(angle_rad, 3) + 0.0:+.3f}"


def _numbers(values: tuple[float, ...], digits: int) -> str:
    return ", ".join(f"{round(value, digits) + 0.0:.{digits}f}" for value in values)
