"""Adds an arm to a project from a URDF or MJCF file: reads it, writes model and sheet, proves that models agree."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pyoxigraph as ox

from skillc.errors import RequestError
from skillc.services.project.manifest import NAME
from skillc.services.project.project import Project
from skillc.services.robot_import.arm_reader import Reading, ReadOptions
from skillc.services.robot_import.comparison import POSTURES, Kinetics, prove_same
from skillc.services.robot_import.mjcf_writer import ControlKind, format_numbers, write_mjcf
from skillc.services.robot_import.options import read_efforts, read_home, read_settings
from skillc.services.robot_import.reader import read_robot
from skillc.services.robot_import.robot_model import RobotModel
from skillc.services.robot_import.sheet_writer import (
    CLASSES,
    COMMON,
    CONTROLLERS,
    GAINS,
    TEXTS,
    SheetFacts,
    write_sheet,
)
from skillc.services.scaffolding.additions import add_device_files
from skillc_dsl.spelling import did_you_mean
from skillc_ontology import catalogue
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.terms import ARM_SHEET, SKILLC

_TYPE = ox.NamedNode("http://www.w3.org/1999/02/22-rdf-syntax-ns#type")
_SUBCLASS = ox.NamedNode("http://www.w3.org/2000/01/rdf-schema#subClassOf")


@dataclass(frozen=True, slots=True)
class ShippedSheet:
    """The values on the data sheet of a shipped arm, by the name of the property, and how it is controlled."""

    name: str
    values: Mapping[str, str]
    control: ControlKind


def read_shipped_sheet(name: str) -> ShippedSheet:
    """Return the data sheet of a shipped arm, such as `ur5e`. RequestError if there is no such arm."""
    folder = catalogue.ROOT / "robots"
    known = sorted(path.stem for path in folder.glob("*.xml"))
    if name not in known:
        raise RequestError(f"there is no robot `{name}`; {did_you_mean(name, known)}")
    graph = ox.Store()
    graph.load(path=str(folder / f"{name}.ttl"), format=ox.RdfFormat.TURTLE)
    (sheet,) = (quad.subject for quad in graph.quads_for_pattern(None, _TYPE, ox.NamedNode(ARM_SHEET)))
    values = {
        quad.predicate.value.removeprefix(SKILLC): quad.object.value
        for quad in graph.quads_for_pattern(sheet, None, None)
        if isinstance(quad.object, ox.Literal)
    }
    above = (quad.object for quad in graph.quads_for_pattern(None, _SUBCLASS, None))
    classes = {each.value.removeprefix(SKILLC) for each in above if isinstance(each, ox.NamedNode)}
    control = next(kind for kind, cls in CLASSES.items() if cls in classes)
    return ShippedSheet(name, values, control)


@dataclass(frozen=True, slots=True)
class RobotRequest:
    """What a user says about an arm besides its file; None and empty texts leave it open.

    like: a shipped arm, whose numbers are taken where neither the file nor the user states one; part: which part of
    the file is the arm; settings: values of the data sheet by property.
    """

    file: Path
    name: str | None = None
    like: str | None = None
    control: ControlKind | None = None
    part: ReadOptions = field(default_factory=ReadOptions)
    efforts: str | None = None
    home: str | None = None
    settings: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class AddedRobot:
    """The files of a new arm, and what its user should know: sentences without full stop, some of them warnings."""

    files: tuple[Path, ...]
    remarks: tuple[str, ...]
    warnings: tuple[str, ...]


def add_robot(project: Project, request: RobotRequest) -> AddedRobot:
    """Write the data sheet and the model of an arm into a project.

    RequestError, and nothing is written, if the file is no arm that skills can use, something is missing that the model
    needs, or the model does not agree with the file.
    """
    name = request.name or _name_of(request.file)
    if not NAME.fullmatch(name):
        raise RequestError(f"`{name}` is not a valid name: use a-z, 0-9 and `_`, starting with a letter (--name NAME)")
    like = read_shipped_sheet(request.like) if request.like else None
    control = request.control or (like.control if like else None)
    if control is None:
        raise RequestError(
            "how the arm is commanded is in no model: --control torque, position or velocity; or --like ARM, a shipped "
            "arm whose kind, gains and limits it takes"
        )
    reading = read_robot(request.file, request.part)
    efforts = read_efforts(reading.model, request.efforts, request.file)
    stated = read_settings(request.settings, control, len(reading.model.links))
    mjcf = write_mjcf(reading.model, name, request.file.name, control, efforts)
    with TemporaryDirectory() as folder:
        path = Path(folder, f"{name}.xml")
        path.write_text(mjcf, "utf-8")
        differences = prove_same(reading.model, reading.source, path)
        modelled, home = _modelled(path, reading, request)
    values, source = _values(modelled, stated, like, control, request.file.name)
    facts = SheetFacts(
        name=name,
        cls="".join(part.capitalize() for part in name.split("_")),
        comment=f"An arm with {len(reading.model.links)} joints, read from {request.file.name}.",
        control=control,
        source=source,
        values=values,
        unstated=_unstated(values, control, home),
        home=None if home is None else format_numbers(np.round(home, 3)),
    )
    sheet = write_sheet(facts, project.name, project.namespace)
    files = add_device_files(project, "robot", name, sheet, mjcf)
    remarks = (*_describe(reading.model, differences), _describe_home(reading.model, facts, request))
    return AddedRobot(
        tuple(files),
        (*(f"{name}: {remark}" for remark in remarks), _show_use(facts, project.name)),
        (*reading.notes, *_list_unstated(facts)),
    )


def _name_of(file: Path) -> str:
    """Return a name for an arm from that of its file."""
    plain = unicodedata.normalize("NFKD", file.name.split(".")[0]).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "_", plain.lower()).strip("_").lstrip("0123456789_")


def _modelled(path: Path, reading: Reading, request: RobotRequest) -> tuple[dict[str, str], Array | None]:
    """Return what the model states of the data sheet, and the home posture (n,), None if none is found."""
    from skillc.services.robot_import.home_posture import HomeSearch

    search = HomeSearch(path)
    home = search.find() if request.home is None else read_home(reading.model, request.home)
    values = {"reach": f"{search.shape.reach_m:g}", "shoulderHeight": f"{search.shape.shoulder_m:g}"}
    speeds = [link.joint.speed for link in reading.model.links]
    known = [speed for speed in speeds if speed is not None]
    if len(known) == len(speeds):
        values["jointSpeeds"] = format_numbers(known)
    if reading.model.armature is not None:
        values["armature"] = f"{reading.model.armature:g}"
    return values, home


def _values(
    modelled: Mapping[str, str], stated: Mapping[str, str], like: ShippedSheet | None, control: ControlKind, file: str
) -> tuple[dict[str, str], str]:
    """Return the values of the data sheet, and their sources in a sentence each."""
    needed = (*COMMON, *GAINS[control])
    taken = {
        name: like.values[name]
        for name in needed
        if like is not None and name in like.values and name not in modelled and name not in stated
    }
    parts = [
        f"Kinematics, inertia, joint limits{', joint speeds' * ('jointSpeeds' in modelled)}: {file}.",
        "Reach: 85 % of the largest distance of flange and shoulder." * ("reach" not in stated),
        f"Stated by the user when the arm was added: {', '.join(stated)}." * bool(stated),
        f"As those of {like.name}, to be checked: {', '.join(taken)}." if like is not None and taken else "",
    ]
    return {**modelled, **taken, **stated}, " ".join(filter(None, parts))


def _unstated(values: Mapping[str, str], control: ControlKind, home: Array | None) -> tuple[str, ...]:
    """Return the properties that nobody has stated, in the order of the sheet."""
    needed = (TEXTS[0], *COMMON, *GAINS[control])
    return (*(name for name in needed if name not in values), *(("hasPosture",) if home is None else ()))


def _describe(model: RobotModel, differences: Kinetics) -> Iterator[str]:
    mass = sum(link.inertia.mass_kg for link in model.links)
    names = ", ".join(link.joint.name for link in model.links)
    yield (
        f"{len(model.links)} joints ({names}) from {model.base.name} to {model.tip}; the links that move weigh "
        f"{mass:.2f} kg"
    )
    yield (
        f"the file in MuJoCo and the model in pinocchio agree in {POSTURES} postures: poses of all links, Jacobians, "
        f"mass matrices and weights; the largest difference is {max(differences):.1e} ({differences.worst})"
    )


def _describe_home(model: RobotModel, facts: SheetFacts, request: RobotRequest) -> str:
    if not facts.home:
        return "home: no posture with the flange pointing down was found"
    unit = "rad, or m for what slides" if any(link.joint.slides for link in model.links) else "rad"
    where = "stated" if request.home else "proposed: the flange points down in front of the base"
    return f"home: {facts.home} {unit}, {where}"


def _list_unstated(facts: SheetFacts) -> Iterator[str]:
    if facts.unstated:
        yield f"still to be stated, in the sheet, with --set or as those of --like: {', '.join(facts.unstated)}"


def _show_use(facts: SheetFacts, prefix: str) -> str:
    needs_force = "forceTorqueTime" in GAINS[facts.control]
    sensor = " ; skillc:hasSensor lab:Sensor-1 . lab:Sensor-1 a skillc:ForceTorqueSensor" * needs_force
    return (
        f"in a scene: lab:Arm-1 a {prefix}:{facts.cls} ; skillc:hasSheet {prefix}:{facts.name}-sheet ; "
        f'skiros:CompliantController "{CONTROLLERS[facts.control]}"{sensor} .'
    )
