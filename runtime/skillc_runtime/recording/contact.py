"""What becomes of the contact of a tool while its run is paused, and after that until the run goes on."""

from __future__ import annotations

from typing import Literal, TypeAlias

ContactState: TypeAlias = Literal["none", "kept", "lifting", "taken-off", "approaching"]
"""none: the run is not paused, or no tool pressed when it was; kept: tools press on; lifting: they are being taken off;
taken-off: they were taken off and are at rest; approaching: they approach until they sense contact."""

SENTENCES: dict[ContactState, str] = {
    "none": "",
    "kept": "the force is kept",
    "lifting": "the tool is being taken off the surface",
    "taken-off": "the tool was taken off the surface; it senses contact again before the task goes on",
    "approaching": "the tool approaches again until it senses contact",
}
"""A sentence for people about each, without a full stop."""
