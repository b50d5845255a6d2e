"""Writes a cell as a library and a scene, as a user could have written them."""

from __future__ import annotations

from pathlib import Path
from string import Template

from random_cells.drawing import ELSEWHERE_M, ELSEWHERE_RAD, TABLE_M, Bin, Cell, Part, Point

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

CAMERA = """lab:Camera-1 a skillc:Camera ; skillc:hasSheet skillc:depth-camera-sheet ;
    skiros:FrameId "camera" ; skiros:BaseFrameId "map" ;
    skiros:PositionX 0.5 ; skiros:PositionY 0.0 ; skiros:PositionZ 2.1 ; skillc:roll 180.0 .

"""


def write_cell(cell: Cell, folder: Path, scene: str = "cell.ttl") -> None:
    """Write the library and a scene of a cell into a folder, whose name is that of the library."""
    folder.mkdir(parents=True, exist_ok=True)
    goal = " and ".join(f"lab:{bin_} contain lab:{part}" for part, bin_ in cell.goal)
    (folder / f"{folder.name}.skill").write_text(SKILL.substitute(goal=goal), "utf-8")
    (folder / scene).write_text(format_scene(cell, folder.name), "utf-8")


def format_scene(cell: Cell, library: str) -> str:
    """Return the scene of a cell as Turtle."""
    inside = {part for part, _ in cell.contained}
    loose = [each for each in cell.parts if each.name not in inside]
    names = [f"lab:{each.name}" for each in (*loose, *cell.bins)] + [f"lab:{name}" for name, _, _ in cell.boxes]
    contained = ", ".join(("lab:Table", "lab:Pedestal", *names))
    return "".join(
        (
            HEAD.replace("$library", library),
            _thing("Cell", "skillc:Workstation", (0, 0, 0), f"    skiros:contain {contained} ;\n"),
            ROBOT,
            ARMS[cell.arm],
            '    skiros:FrameId "arm" ; skiros:BaseFrameId "robot" ; skillc:deviceState "Idle" ;\n',
            f"{_position((0, 0, TABLE_M))} .\n\n",
            f'lab:Hand-1 a {HANDS[cell.arm]} ; skiros:FrameId "hand" ; skillc:deviceState "Idle" .\n\n',
            _thing("Pedestal", "skillc:Furniture", (0, 0, TABLE_M), _size((0.3, 0.3, TABLE_M))),
            _thing("Table", "skillc:Furniture", (0.5, 0, TABLE_M), _size((0.68, 1.3, TABLE_M))),
            *(_format_part(each, is_elsewhere=cell.has_camera and each in loose) for each in cell.parts),
            *(_format_bin(each, cell) for each in cell.bins),
            *(_thing(name, "skillc:Furniture", at, _size(size)) for name, size, at in cell.boxes),
            CAMERA if cell.has_camera else "",
        )
    )


def _format_part(part: Part, *, is_elsewhere: bool) -> str:
    shape = part.shape if part.shape in ("cylinder", "sphere") else "box"
    facts = f'    skiros:Weight {part.mass_kg} ; skillc:shape "{shape}" ; skillc:friction {part.friction} ;\n'
    facts += f"    skillc:roll {part.roll_deg} ; skillc:yaw {part.yaw_deg} ;\n"
    if is_elsewhere:
        facts += f"    skillc:positionRange {ELSEWHERE_M} ; skillc:turnRange {ELSEWHERE_RAD} ;\n"
    return _thing(part.name, "cell:WorkPart", part.at, _size(part.size) + facts)


def _format_bin(bin_: Bin, cell: Cell) -> str:
    facts = "" if bin_.size is None else _size(bin_.size)
    inside = [f"lab:{part}" for part, holder in cell.contained if holder == bin_.name]
    facts += f"    skiros:contain {', '.join(inside)} ;\n" if inside else ""
    cls = "cell:Bin" if bin_.size is not None else "skiros:Location"
    return _thing(bin_.name, cls, bin_.at, facts)


def _thing(name: str, cls: str, at: Point, facts: str) -> str:
    frame = f'    skiros:FrameId "{name}" ; skiros:BaseFrameId "map" ;\n'
    return f"lab:{name} a {cls} ;\n{facts}{frame}{_position(at)} .\n\n"


def _position(at: Point) -> str:
    x, y, z = at
    return f"    skiros:PositionX {x:.4f} ; skiros:PositionY {y:.4f} ; skiros:PositionZ {z:.4f}"


def _size(size: Point) -> str:
    x, y, z = size
    return f"    skiros:SizeX {x:.4f} ; skiros:SizeY {y:.4f} ; skiros:SizeZ {z:.4f} ;\n"
