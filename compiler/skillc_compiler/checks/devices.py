"""`uses` of what is no individual, and `shares` of what is no device."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.labels import label_declaration
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Parameter, Skill
from skillc_compiler.program.types import UNKNOWN, Thing, describe_type, fits
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.types import THING, Vocabulary

NAMES = ("not-a-device",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION
DEVICE = "http://www.inf.ufrgs.br/phi-group/ontologies/sumo.owl#Device"


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `uses` and `shares` of a value, an output, or of what can certainly not be used so."""
    for skill in program.skills.values():
        for device in skill.devices:
            parameter = skill.parameter(device.parameter.text)
            if parameter is not None:
                yield from _check_device(program.vocabulary, skill, device, parameter)


def _check_device(
    vocabulary: Vocabulary, skill: Skill, device: s.DeviceUse, parameter: Parameter
) -> Iterator[Diagnostic]:
    what = _reason(vocabulary, parameter, device.kind)
    if what is None:
        return
    fitting = [p.name for p in skill.parameters if p.type != UNKNOWN and _reason(vocabulary, p, "shares") is None]
    is_output = parameter.direction == "out"
    meant = "individuals" if device.kind == "uses" else "devices"
    names = " or ".join(f"`{device.kind} {name}`" for name in fitting)
    cures = ("declare it with `in`" if is_output else "", f"write {names}" if names else "")
    yield Diagnostic(
        "not-a-device",
        device.parameter.span,
        f"`{parameter.name}` {what}, and `{device.kind}` is for {meant}",
        help=" or ".join(filter(None, cures)) or "remove the line",
        labels=(Label(parameter.span, "declared here", is_cause=is_output), *_label_class(vocabulary, parameter)),
    )


def _label_class(vocabulary: Vocabulary, parameter: Parameter) -> tuple[Label, ...]:
    term = vocabulary.classes.get(parameter.type.cls or THING) if isinstance(parameter.type, Thing) else None
    return label_declaration(term) if term is not None else ()


def _reason(vocabulary: Vocabulary, parameter: Parameter, kind: str) -> str | None:
    """Return why a parameter cannot be used or shared, None if it can."""
    if parameter.type == UNKNOWN:
        return None
    if not isinstance(parameter.type, Thing):
        return f"is {describe_type(parameter.type)}"
    if parameter.direction == "out":
        return "is an output, which has no value when the skill starts"
    cls = parameter.type.cls
    if kind == "uses" or cls is None or cls == THING or vocabulary.is_a(cls, DEVICE):
        return None
    below = (iri for iri in vocabulary.classes if fits(vocabulary, Thing(iri), Thing(cls)))
    if DEVICE in vocabulary.classes and not any(vocabulary.is_a(iri, DEVICE) for iri in below):
        return f"is {describe_type(parameter.type)}, which no device is"
    return None
