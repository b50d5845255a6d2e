"""Texts of shipped libraries, and one with syntax errors."""

from importlib.resources import files
from pathlib import Path

_FOLDER = Path(str(files("skillc_skills")))
TEXTS = (
    *(path.read_text("utf-8") for path in sorted((_FOLDER / "std").glob("*.skill"))[:3]),
    "use skiros\nskill Broken {\n    in arm ArmDevice\n    pre arm hasA\n}\n",
)
