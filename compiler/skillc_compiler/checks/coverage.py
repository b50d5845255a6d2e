"""A class that a skill promises to work with and that none of its implementations takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.logic.selection import types_overlap
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Argument, Call, Implementation, Parameter, Skill
from skillc_compiler.program.types import Thing, describe_type, fits
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.types import Vocabulary, local_name

NAMES = ("no-fitting-implementation",)
NEEDS = Need.PROGRAM
READS = Reads.FAMILY
SHOWN = 3


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each parameter with classes that nothing takes, a problem for each such argument."""
    for skill in program.skills.values():
        implementations = program.implementations_of[skill.name]
        for index, parameter in enumerate(skill.parameters if implementations else ()):
            taken = [implementation.parameters[index] for implementation in implementations]
            yield from _check_parameter(program.vocabulary, skill, parameter, taken)
    for call in program.calls:
        if call.skill:
            yield from _check_call(program, call, call.skill)


def _check_parameter(
    vocabulary: Vocabulary, skill: Skill, parameter: Parameter, taken: Sequence[Parameter]
) -> Iterator[Diagnostic]:
    if not isinstance(parameter.type, Thing) or any(fits(vocabulary, parameter.type, each.type) for each in taken):
        return
    classes = [iri for iri in _lowest(vocabulary) if fits(vocabulary, Thing(iri), parameter.type)]
    missing = [c for c in classes if not any(fits(vocabulary, Thing(c), each.type) for each in taken)]
    if missing:
        names = ", ".join(f"`{local_name(iri)}`" for iri in missing[:SHOWN])
        more = f" and {len(missing) - SHOWN} more classes" if len(missing) > SHOWN else ""
        yield Diagnostic(
            "no-fitting-implementation",
            parameter.span,
            f"no implementation of `{skill.name}` takes {names}{more}, which `{parameter.name}` may be",
            help="narrow the class of the parameter, or add an implementation",
            severity="warning",
        )


def _lowest(vocabulary: Vocabulary) -> list[str]:
    """Return the classes without subclasses."""
    parents = {parent for term in vocabulary.classes.values() for parent in term.parents}
    return sorted(iri for iri in vocabulary.classes if iri not in parents)


def _check_call(program: Program, call: Call, skill: Skill) -> Iterator[Diagnostic]:
    candidates = program.candidates(call)
    for argument in call.values:
        parameter = skill.parameter(argument.name.text)
        if parameter is None or not candidates or not fits(program.vocabulary, argument.value.type, parameter.type):
            continue
        taken = [each.parameters[skill.parameters.index(parameter)] for each in candidates]
        if not any(types_overlap(program.vocabulary, argument.value.type, each.type) for each in taken):
            yield _problem(argument, skill, candidates)


def _problem(argument: Argument, skill: Skill, candidates: Sequence[Implementation]) -> Diagnostic:
    one = len(candidates) == 1
    which = f"`{skill.name}[{candidates[0].name}]` does not" if one else f"no implementation of `{skill.name}` does"
    return Diagnostic(
        "no-fitting-implementation",
        argument.value.span,
        f"this is {describe_type(argument.value.type)}, which {which} take as `{argument.name.text}`",
        help="pass something else, or add an implementation",
        labels=tuple(Label(each.name_span, f"`{each.name}` is for others") for each in candidates[:SHOWN]),
    )
