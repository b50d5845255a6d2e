"""Scenes of surfaces that an arm can wipe, or cannot, and of two mobile bases."""

from pathlib import Path

from skillc_ontology import catalogue

DESK = catalogue.scene_path("panda_desk").read_text()
LARGE = ("SizeX 0.30 ; skiros:SizeY 0.40", "SizeX 0.40 ; skiros:SizeY 0.60")
PLACE = "PositionX 0.5 ; skiros:PositionY 0.05 ; skiros:PositionZ 0.75 ;"


def tilt_desk(x: float, pitch_deg: float, z: float) -> str:
    """Return the scene of a desk of 0.40 x 0.60 m before a Panda, tilted as a door, on which 12 N are pressed.

    It is at x and z, in m.
    """
    tilted = f"PositionX {x} ; skiros:PositionY 0.05 ; skiros:PositionZ {z} ; skillc:pitch {pitch_deg} ;"
    text = DESK.replace(*LARGE).replace(PLACE, tilted).replace("normalForce 10.0", "normalForce 12.0")
    assert tilted in text
    return text


def write_door(folder: Path, x: float, pitch_deg: float, z: float) -> Path:
    """Write the scene of `tilt_desk`."""
    scene = folder / "door.ttl"
    scene.write_text(tilt_desk(x, pitch_deg, z))
    return scene


def two_bases() -> str:
    """Return the scene of a UR5e on a base at the dock with another one, lab:Heron-2, which is at the store."""
    text = catalogue.scene_path("ur5e_whiteboard").read_text()
    robot = text[text.index("lab:Heron-1 a") : text.index("# --- the workstations")]
    other = robot.replace("-1", "-2").replace("lab:Dock", "lab:Store")
    for frame in ("heron", "ur5e_base", "wsg"):
        other = other.replace(f'"{frame}"', f'"{frame}_2"')
    return text.replace(robot, robot + other)
