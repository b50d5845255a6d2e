"""A yard whose texts and names try to be more than text: markup, scripts, links, marks that turn text, long words."""

from __future__ import annotations

from pathlib import Path

from running_cells.yard import write_yard
from skillc.cells.settings import CellSettings

MARKUP = "<i class=hostile onclick=alert(1)>x</i><img class=hostile src=http://example.org/x onerror=alert(2)>"
LINK = "javascript:alert(3)"
TURNED = "\u202egnp.exe\u2066"
LONG = "Incomprehensibilities" * 12
TEXT = f"{MARKUP} {LINK} {TURNED} {LONG}"
FILE = f"<img class=hostile src=x onerror=alert(4)>{TURNED}.skill"
"""The name of a file of the library."""
THING = f"http://example.org/lab#{LINK}{TURNED}"
"""The IRI of an individual, whose last part is its name."""
SKILLS = f"""# {TEXT}

use skiros
import "asking.skill"

prefix lab: <http://example.org/lab#>

## {TEXT}
skill Doubt {{
    noplan
    ## {TEXT}
    in  about: Product
}}
impl {LONG} of Doubt {{
    do seq {{
        Ask(text: "{TEXT}", choices: "{MARKUP} | {LONG}", limit: 60 s) -> said
        check(said == "{TEXT}")
        wait 10 ms
    }}
}}

## {TEXT}
task doubt(
    ## {TEXT}
    about: Product
) {{
    scene "yard.ttl"
    do Doubt(about)
}}

## {TEXT}
task {LONG} {{
    scene "yard.ttl"
    goal forall c: Product (lab:Goal contain c)
}}
"""


def write_hostile_yard(folder: Path, takes_ms: int = 10) -> CellSettings:
    """Write a yard with such texts in library, scene and the name of a file; return the settings of its cell."""
    settings = write_yard(folder, takes_ms)
    (folder / FILE).write_text(SKILLS, encoding="utf-8")
    scene = folder / "yard.ttl"
    things = (f"<{THING}>", f"lab:{LONG}")
    more = "".join(f"lab:Start skiros:contain {each} .\n{each} a skiros:Product .\n" for each in things)
    scene.write_text(scene.read_text("utf-8") + more, encoding="utf-8")
    return settings
