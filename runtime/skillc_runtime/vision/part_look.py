"""What is known of a kind of parts before somebody looks at one: its codes, its label, and how a good one looks."""

from __future__ import annotations

import msgspec

from skillc_runtime.vision.inspected_surface import Rgb
from skillc_runtime.vision.labels import plate_m

TOLERATED_M2 = 4e-6
"""The area of a defect up to which a part is good, unless it is stated: 2 mm square."""

PAPER: Rgb = (243.0, 243.0, 243.0)
"""The white of labels."""


class PartLook(msgspec.Struct, frozen=True):
    """A kind of parts, by name or IRI: one colour on a flat face of size (2,) in m, and a label in the middle of it.

    Labels have the codes from the first to the last; their black squares have the edge `label_m`, along the edges of
    the face. A part is good if what looks otherwise has an area of at most `tolerated_m2`.
    """

    kind: str
    codes: tuple[int, int]
    size: tuple[float, float]
    label_m: float
    colour: Rgb
    tolerated_m2: float = TOLERATED_M2

    @property
    def plate_m(self) -> float:
        """The edge in m of a label with its rim."""
        return plate_m(self.label_m)
