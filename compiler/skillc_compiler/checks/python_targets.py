"""Python that is not there, or that takes other parameters than the skill has.

What a skill or function runs is looked up in the Python of this machine. Nothing is imported or run: the text of the
module is read.

## bad-python-target: a target is not written `module:name`

Bad:

    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in.StandIn" }

Good:

    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## missing-python: there is no such module, or nothing of that name in it

A warning only: the machine that compiles may lack the robot's Python. Where it is missing, running is refused.

Bad:

    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIm" }

Good:

    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## wrong-python-parameters: a class or function takes other parameters than the skill gives

The constructor of a primitive takes the cell and, by name, each parameter of the skill except outputs. A function takes
the world and its values, in order.

Bad:

    use rparts
    skill Fold {
        in arm:  ArmDevice
        in pace: Number
        noplan
    }
    impl folded of Fold { run python "skillc_runtime.primitives.move:TakePosture" }

Good:

    use rparts
    skill Fold {
        in arm:     ArmDevice
        in posture: Text
        in pace:    Number
        noplan
    }
    impl folded of Fold { run python "skillc_runtime.primitives.move:TakePosture" }
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from skillc_compiler.program import Implementation, Program
from skillc_compiler.python_source import NoModule, NoName, Signature, Unclear, signature
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label, did_you_mean

NAMES = ("bad-python-target", "missing-python", "wrong-python-parameters")
_TARGET = re.compile(r"([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*):([A-Za-z_]\w*)")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each target that does not name fitting Python."""
    for implementation in program.implementations:
        if isinstance(implementation.body, s.RunPython):
            yield from _primitive(implementation, implementation.body.target)
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.FunctionDeclaration):
                yield from _function(declaration)


def _primitive(implementation: Implementation, written: s.Text) -> Iterator[Diagnostic]:
    found = _found(written)
    if not isinstance(found, Signature):
        yield from found
        return
    given = [p.name for p in implementation.parameters if p.direction != "out"]
    untaken = [] if found.more else [name for name in given if name not in found.names]
    ungiven = sorted(found.needed - set(given))
    if untaken or ungiven:
        takes = f"takes no `{'`, `'.join(untaken)}`" if untaken else f"needs `{'`, `'.join(ungiven)}`"
        label = Label(implementation.skill.name_span, f"the skill has {_listed(given)}")
        yield _unlike(written, takes, f"let its constructor take the cell and {_listed(given)}", label)


def _function(declared: s.FunctionDeclaration) -> Iterator[Diagnostic]:
    found = _found(declared.python)
    if not isinstance(found, Signature):
        yield from found
        return
    given = [parameter.name.text for parameter in declared.parameters]
    if len(given) < len(found.needed) or (len(given) > len(found.names) and not found.more):
        takes = f"takes {_listed(found.names)} after the world, {len(found.names)} in number"
        label = Label(declared.name.span, f"the function has {_listed(given)}")
        yield _unlike(declared.python, takes, f"let it take the world and {_listed(given)}", label)


def _found(written: s.Text) -> Signature | Sequence[Diagnostic]:
    """Return what the target takes, or what is wrong with it; nothing is wrong where that cannot be told."""
    target = _TARGET.fullmatch(written.value)
    if target is None:
        message = f'"{written.value}" does not name something in a Python module'
        return [Diagnostic("bad-python-target", written.span, message, 'write "package.module:Name"')]
    module, name = target.groups()
    match signature(module, name):
        case Signature() as found:
            return found
        case NoModule(installed=True):
            return [_missing(written, f"there is no Python module `{module}`", "make the file, or correct the name")]
        case NoModule():
            message = f"the Python module `{module}` is not installed here, so it cannot be checked"
            help_ = "install it where the skill is checked and run, or correct the name"
            return [_missing(written, message, help_)]
        case NoName(there=there):
            message = f"the Python module `{module}` has no `{name}`"
            return [_missing(written, message, did_you_mean(name, there) or "write it there, or correct the name")]
        case Unclear():
            return []


def _missing(written: s.Text, message: str, help_: str) -> Diagnostic:
    return Diagnostic("missing-python", written.span, message, help_, severity="warning")


def _unlike(written: s.Text, takes: str, help_: str, label: Label) -> Diagnostic:
    message = f"`{written.value.partition(':')[2]}` {takes}"
    return Diagnostic("wrong-python-parameters", written.span, message, help_, "warning", (label,))


def _listed(names: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in names) or "nothing else"
