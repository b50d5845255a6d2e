"""Reads an arm from a file of either format."""

from __future__ import annotations

from pathlib import Path

from skillc.services.robot_import.reading import Reading, ReadOptions
from skillc.services.robot_import.xml_file import read_xml

ASKEW = 0.99
"""Least cosine of the angle between the z axis of the flange and the axis of a last joint that turns."""


def read_robot(path: Path, options: ReadOptions | None = None) -> Reading:
    """Return the arm in a URDF or MJCF file; RequestError if there is no arm that can be used."""
    form, root = read_xml(path)
    if form == "urdf":
        from skillc.services.robot_import.urdf_reader import read_urdf

        reading = read_urdf(path, root, options or ReadOptions())
    else:
        from skillc.services.robot_import.mjcf_reader import read_mjcf

        reading = read_mjcf(path, options or ReadOptions())
    return reading.with_notes(_flange_notes(reading))


def _flange_notes(reading: Reading) -> tuple[str, ...]:
    """Return a doubt about a flange whose z axis is not that of the last joint."""
    model = reading.model
    last = model.links[-1].joint
    if last.slides or float(model.flange.rotation[:, 2] @ last.axis) ** 2 > ASKEW**2:
        return ()
    return (
        f"the z axis of `{model.tip}` is not along the axis of the last joint, and should point out of the flange: "
        "turn it with --tip-turn ROLL PITCH YAW, in degrees, if it does not",
    )
