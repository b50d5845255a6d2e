"""Writes a cell as a library and a scene, as a user could have written them."""

from __future__ import annotations

from math import cos, radians, sin
from pathlib import Path
from string import Template

from random_cells.drawing import TABLE_M, Bin, Cell, Part, Point

TASK = "sort_parts"

SKILL = Template("""# Parts are sorted into bins.

prefix lab: <http://example.org/lab#>
use skiros
import "handling.skill"

class WorkPart < Product
class Bin < Container

task sort_parts {
    scene "cell.ttl"
    goal  $goal
}
""")

HEAD = """@prefix lab:    <http://example.org/lab#> .
@prefix cell:   <https://w3id.org/skillc/library/$library#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Scene-1 a skiros:Scene ; skiros:contain lab:Cell .

"""

ROBOT = """lab:Robot-1 a skillc:FixedRobot ;
    skiros:FrameId "robot" ; skiros:at lab:Cell ; skillc:hasArm lab:Arm-1 .

"""

ARMS = {
    "iiwa14": """lab:Arm-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:iiwa14-sheet ;
    skiros:CompliantController "impedance" ; skillc:hasGripper lab:Hand-1 ;
""",
    "panda": """lab:Arm-1 a skillc:Panda ; skillc:hasSheet skillc:panda-sheet ; skiros:CompliantController "impedance" ;
    skillc:hasGripper lab:Hand-1 ;
""",
    "ur5e": """lab:Sensor-1 a skillc:ForceTorqueSensor ; skillc:forceNoise 0.5 ; skillc:torqueNoise 0.02 .
lab:Arm-1 a skillc:Ur5e ; skillc:hasSheet skillc:ur5e-sheet ; skiros:CompliantController "forward_dynamics" ;
    skillc:hasGripper lab:Hand-1 ; skillc:hasSensor lab:Sensor-1 ;
""",
}
HANDS = {
    "iiwa14": "skillc:RobotiqGripper ; skillc:hasSheet skillc:robotiq-3f-sheet",
    "panda": "skillc:PandaHand ; skillc:hasSheet skillc:panda-hand-sheet",
    "ur5e": "skillc:WsgGripper ; skillc:hasSheet skillc:wsg50-sheet",
}

DOWN = (0.0, 1.0, 0.0, 0.0)
"""The orientation (w, x, y, z) of a hand that points down."""


def write_cell(cell: Cell, folder: Path, scene: str = "cell.ttl") -> None:
    """Write the library and a scene of a cell into a folder, whose name is that of the library."""
    folder.mkdir(parents=True, exist_ok=True)
    goal = " and ".join(f"lab:{bin_} contain lab:{part}" for part, bin_ in cell.goal)
    (folder / f"{folder.name}.skill").write_text(SKILL.substitute(goal=goal), "utf-8")
    (folder / scene).write_text(format_scene(cell, folder.name), "utf-8")


def format_scene(cell: Cell, library: str) -> str:
    """Return the scene of a cell as Turtle."""
    inside = {part for part, _ in cell.contained}
    loose = [f"lab:{each.name}" for each in cell.parts if each.name not in inside]
    loose += [f"lab:{each.name}" for each in cell.bins] + [f"lab:{name}" for name, _, _ in cell.boxes]
    contained = ", ".join(("lab:Table", "lab:Pedestal", *loose))
    return "".join(
        (
            HEAD.replace("$library", library),
            _thing("Cell", "skillc:Workstation", (0, 0, 0), f"    skiros:contain {contained} ;\n"),
            ROBOT,
            ARMS[cell.arm],
            '    skiros:FrameId "arm" ; skiros:BaseFrameId "robot" ; skillc:deviceState "Idle" ;\n',
            f"{_pose((0, 0, TABLE_M))} .\n\n",
            f'lab:Hand-1 a {HANDS[cell.arm]} ; skiros:FrameId "hand" ; skillc:deviceState "Idle" .\n\n',
            _thing("Pedestal", "skillc:Furniture", (0, 0, TABLE_M), _size((0.3, 0.3, TABLE_M))),
            _thing("Table", "skillc:Furniture", (0.5, 0, TABLE_M), _size((0.6, 1.3, TABLE_M))),
            *map(_format_part, cell.parts),
            *(_format_bin(each, cell) for each in cell.bins),
            *(_thing(name, "skillc:Furniture", at, _size(size)) for name, size, at in cell.boxes),
        )
    )


def _format_part(part: Part) -> str:
    shape = part.shape if part.shape in ("cylinder", "sphere") else "box"
    facts = f'    skiros:Weight {part.mass_kg} ; skillc:shape "{shape}" ; skillc:friction {part.friction} ;\n'
    facts += f"    skillc:graspWidth {part.size[1]} ; skillc:graspForce 30.0 ;\n"
    facts += f"    skiros:hasA lab:{part.name}-grasp, lab:{part.name}-approach ;\n"
    turn = radians(part.roll_deg) / 2
    said = _thing(part.name, "cell:WorkPart", part.at, _size(part.size) + facts, (cos(turn), sin(turn), 0.0, 0.0))
    over = 0.0 if part.shape == "sphere" else 0.01
    said += _pose_of(f"{part.name}-grasp", "skiros:GraspingPose", part.name, (0, 0, over))
    return said + _pose_of(f"{part.name}-approach", "skiros:ApproachPose", part.name, (0, 0, 0.14))


def _format_bin(bin_: Bin, cell: Cell) -> str:
    facts = "" if bin_.size is None else _size(bin_.size)
    facts += f"    skiros:hasA lab:{bin_.name}-placing ;\n"
    inside = [f"lab:{part}" for part, holder in cell.contained if holder == bin_.name]
    facts += f"    skiros:contain {', '.join(inside)} ;\n" if inside else ""
    cls = "cell:Bin" if bin_.size is not None else "skiros:Location"
    bottom = 0.0 if bin_.size is None else 0.006 - bin_.size[2] / 2
    said = _thing(bin_.name, cls, bin_.at, facts)
    return said + _pose_of(f"{bin_.name}-placing", "skiros:PlacingPose", bin_.name, (0, 0, bottom))


def _thing(
    name: str, cls: str, at: Point, facts: str, turn: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
) -> str:
    frame = f'    skiros:FrameId "{name}" ; skiros:BaseFrameId "map" ;\n'
    return f"lab:{name} a {cls} ;\n{facts}{frame}{_pose(at, turn)} .\n\n"


def _pose_of(name: str, cls: str, carrier: str, at: Point) -> str:
    frame = f'    skiros:FrameId "{name}" ; skiros:BaseFrameId "{carrier}" ;\n'
    return f"lab:{name} a {cls} ;\n{frame}{_pose(at, DOWN)} .\n\n"


def _pose(at: Point, turn: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)) -> str:
    (x, y, z), (w, i, j, k) = at, turn
    return (
        f"    skiros:PositionX {x:.4f} ; skiros:PositionY {y:.4f} ; skiros:PositionZ {z:.4f} ;\n"
        f"    skiros:OrientationW {w:.6f} ; skiros:OrientationX {i:.6f} ; "
        f"skiros:OrientationY {j:.6f} ; skiros:OrientationZ {k:.6f}"
    )


def _size(size: Point) -> str:
    x, y, z = size
    return f"    skiros:SizeX {x:.4f} ; skiros:SizeY {y:.4f} ; skiros:SizeZ {z:.4f} ;\n"
