"""Gives the model and the data sheet of a shipped tool another size; the handle, which fingers hold, keeps its size."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from skillc.errors import RequestError
from skillc_runtime.motion.pose import Array

LEAST_M, MOST_M = 0.005, 1.0
HANDLE = "handle"
_PAD = re.compile(r"(?P<name>skillc:pad(?:Stiffness|Damping)) (?P<value>[\d.]+)")


class ResizedTool(NamedTuple):
    """The texts of a tool of another size (3,) in m without its handle, and its weight in kg."""

    sheet: str
    model: str
    size: Array
    weight_kg: float


def resize_tool(sheet: str, model: str, size: Sequence[float], name: str) -> ResizedTool:
    """Return a tool of the same material whose working part has a size (3,) in m: its weight follows from its volume.

    A pad is an elastic foundation: it is stiffer with its area, and softer with its thickness. RequestError for a size
    that no tool in a hand has.
    """
    wanted = np.array(size)
    if not ((wanted >= LEAST_M) & (wanted <= MOST_M)).all():
        raise RequestError(f"--size: write three lengths in m, each from {LEAST_M:g} to {MOST_M:g}")
    root = ElementTree.fromstring(model)
    block = root.find("worldbody/body")
    assert block is not None, "a shipped tool is one body"
    old = _extent(block)
    if block.find(".//geom[@class='rib']") is not None and wanted[2] / 2 >= wanted[:2].min():
        raise RequestError("--size: the tool must be wider than half of its height: its pad has round rims")
    weight_kg = _Scaling(old, wanted).apply(block)
    stiffer = wanted[0] * wanted[1] / wanted[2] / (old[0] * old[1] / old[2])
    millimetres = " x ".join(f"{1000 * each:g}" for each in wanted)
    header = f"<!-- {name}: {millimetres} mm without its handle; made from a shipped tool of the same material. -->\n"
    scaled = _PAD.sub(lambda found: f"{found['name']} {float(found['value']) * stiffer:.1f}", sheet)
    return ResizedTool(scaled, f"{header}{ElementTree.tostring(root, 'unicode')}\n", wanted, weight_kg)


class _Scaling:
    """Scales the elements of a model from one size (3,) in m to another."""

    def __init__(self, old: Array, new: Array) -> None:
        self._old, self._new, self._factors = old, new, new / old

    def apply(self, body: ElementTree.Element) -> float:
        """Scale a body with all in it; return its weight in kg."""
        weight_kg = 0.0
        for each in body:
            match each.tag:
                case "inertial":
                    weight_kg += self._scale_inertia(each)
                case "geom" if each.get("class") == "rib":
                    self._scale_rib(each)
                case "geom" if each.get("name") == HANDLE:
                    higher = np.array([0.0, 0.0, (self._new[2] - self._old[2]) / 2])
                    _write(each, "pos", _read(each, "pos") + higher)
                case "body":
                    _write(each, "pos", _read(each, "pos") * self._factors)
                    weight_kg += self.apply(each)
                case _:
                    self._scale_lengths(each)
        return weight_kg

    def _scale_lengths(self, element: ElementTree.Element) -> None:
        for name in ("size", "pos"):
            if element.get(name) is not None:
                _write(element, name, _read(element, name) * self._factors)

    def _scale_inertia(self, inertial: ElementTree.Element) -> float:
        """Scale a mass with the volume, and its moments with mass and lengths; return the mass in kg."""
        mass_kg = float(inertial.get("mass", "0")) * float(self._factors.prod())
        moments = _read(inertial, "diaginertia")
        spread = (moments.sum() / 2 - moments) * self._factors.prod() * self._factors**2
        inertial.set("mass", f"{mass_kg:.4g}")
        _write(inertial, "pos", _read(inertial, "pos") * self._factors)
        _write(inertial, "diaginertia", spread.sum() - spread)
        return mass_kg

    def _scale_rib(self, rib: ElementTree.Element) -> None:
        """Let a rib reach as near to the rim of the face as before: its radius is half of the thickness of the pad."""
        radius, thinner = self._old[2] / 4, self._new[2] / 4
        inset = np.array([*(self._new[:2] / 2 - thinner) / (self._old[:2] / 2 - radius), 1.0])
        _write(rib, "fromto", _read(rib, "fromto") * np.tile(inset, 2))
        rib.set("size", f"{thinner:.5g}")


def _extent(block: ElementTree.Element) -> Array:
    """Return the extent (3,) in m of all boxes but the handle."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for geom, at in _boxes(block, np.zeros(3)):
        low, high = np.minimum(low, at - _read(geom, "size")), np.maximum(high, at + _read(geom, "size"))
    extent: Array = high - low
    return extent


def _boxes(body: ElementTree.Element, place: Array) -> Iterator[tuple[ElementTree.Element, Array]]:
    for geom in body.findall("geom"):
        if geom.get("type") == "box" and geom.get("name") != HANDLE:
            yield geom, place + _read(geom, "pos")
    for below in body.findall("body"):
        yield from _boxes(below, place + _read(below, "pos"))


def _read(element: ElementTree.Element, name: str) -> Array:
    return np.array([float(each) for each in element.get(name, "0 0 0").split()])


def _write(element: ElementTree.Element, name: str, values: Array) -> None:
    element.set(name, " ".join(f"{each:.5g}" for each in values))
