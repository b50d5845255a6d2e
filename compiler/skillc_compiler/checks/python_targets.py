"""Python targets that do not exist, or whose parameters differ from those of the skill."""

from __future__ import annotations

import keyword
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

from skillc_compiler.checks.bad_targets import split_target
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Implementation
from skillc_compiler.python.info import (
    BrokenModule,
    ClassInfo,
    FunctionInfo,
    NoModule,
    NoName,
    Other,
    PythonSignature,
    TargetInfo,
    Unclear,
)
from skillc_compiler.python.targets import NamedPython
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label, Severity
from skillc_dsl.spelling import did_you_mean

NAMES = ("missing-python", "wrong-python-parameters", "not-a-primitive")
NEEDS = Need.BODY
READS = Reads.PYTHON
PRIMITIVE = "skillc_runtime.primitives.primitive:Primitive"
CALLED_WITH = {"start": 0, "tick": 0, "halt": 1, "pause": 0, "withdraw": 0, "approach": 0, "resume": 0, "release": 0}
"""The methods of a primitive that are called, with the number of arguments."""
_FORBIDDEN = {
    "self": "a constructor has the object itself as `self`",
    "cell": "a constructor has the devices and the world as `cell`",
}
_WORD = "it is a word of Python, which no constructor can take by name"
_Reader: TypeAlias = Callable[[str, str], TargetInfo]


def check(of: NamedPython) -> Iterator[Diagnostic]:
    """Yield a problem for each target that does not name a fitting Python object."""
    program, reader = of.program, of.targets.read
    for implementation in program.implementations:
        if isinstance(implementation.body, s.RunPython):
            yield from _primitive(implementation, implementation.body.target, reader)
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.FunctionDeclaration):
                yield from _function(declaration, reader)


def _primitive(implementation: Implementation, written: s.Text, reader: _Reader) -> Iterator[Diagnostic]:
    match _found(written, reader):
        case ClassInfo() as found:
            yield from _class(implementation, written, found)
        case FunctionInfo() | Other():
            yield _not_a_primitive(written, "is not a class", f"name a subclass of {PRIMITIVE.replace(':', '.')}")
        case Unclear():
            return
        case problem:
            yield problem


def _class(implementation: Implementation, written: s.Text, found: ClassInfo) -> Iterator[Diagnostic]:
    tick = found.methods.get("tick")
    if found.complete and PRIMITIVE not in found.ancestors:
        yield _not_a_primitive(written, "is not a primitive", f"let it inherit from {PRIMITIVE.replace(':', '.')}")
    elif found.complete and ("tick" not in found.methods or (tick is not None and tick.owner == PRIMITIVE)):
        yield _not_a_primitive(written, "has no method `tick`", "define `tick`, which returns RUNNING or SUCCESS")
    for name, count in CALLED_WITH.items():
        method = found.methods.get(name)
        if method is not None and (misfit := _not_callable(method.function, count)):
            yield _not_a_primitive(
                written, f"has a method `{name}` that {misfit}", f"define it as `{_head(name, count)}`"
            )
    given = [p.name for p in implementation.parameters if p.direction != "out"]
    wrong = _by_name(found.constructor, given) if found.constructor is not None else None
    if wrong:
        yield _misfit(implementation, written, wrong, given)


def _misfit(implementation: Implementation, written: s.Text, wrong: str, given: Sequence[str]) -> Diagnostic:
    """Report that a constructor takes other parameters, or that Python allows none of such a name."""
    forbidden = [each for each in implementation.parameters if each.name in given and _is_forbidden(each.name)]
    if forbidden:
        name = forbidden[0].name
        label = Label(forbidden[0].span, f"call it `own_{name}`, for example", is_cause=True)
        return _wrong_parameters(
            written, wrong, f"{_FORBIDDEN.get(name, _WORD)}: give the parameter another name", label
        )
    label = Label(implementation.skill.name_span, f"the skill has {_format_names(given)}")
    return _wrong_parameters(written, wrong, f"let its constructor take the cell and {_format_names(given)}", label)


def _is_forbidden(name: str) -> bool:
    return keyword.iskeyword(name) or name in _FORBIDDEN


def _by_name(taken: PythonSignature, given: Sequence[str]) -> str | None:
    """Return why a constructor cannot be called with the cell and these parameters by name, None if it can."""
    if not taken.by_position and not taken.args:
        return "takes no cell as its first value"
    left = taken.without_first(1)
    unnamed = left.by_position[: left.unnamed]
    names = (*left.by_position[left.unnamed :], *left.by_name)
    untaken = [name for name in given if name not in names and (not left.named or name in taken.by_position)]
    ungiven = sorted(set(left.needed) - set(given))
    if beyond := [name for name in untaken if name in unnamed]:
        return f"takes `{'`, `'.join(beyond)}` by position only"
    if untaken:
        return f"takes no `{'`, `'.join(untaken)}`"
    return f"needs `{'`, `'.join(ungiven)}`" if ungiven else None


def _not_callable(method: FunctionInfo, count: int) -> str | None:
    """Return why a method cannot be called with `count` arguments, None if it can or is not determined."""
    if method.asynchronous:
        return "is `async`, which is never waited for"
    taken = method.signature
    if taken is None:
        return None
    missing = set(taken.needed) - set(taken.by_position[:count])
    if missing or (len(taken.by_position) < count and not taken.args):
        return f"takes {_format_names((*taken.by_position, *taken.by_name))}"
    return None


def _head(name: str, count: int) -> str:
    return f"def {name}(self{', reason' * count})"


def _function(declared: s.FunctionDeclaration, reader: _Reader) -> Iterator[Diagnostic]:
    given = [parameter.name.text for parameter in declared.parameters]
    match _found(declared.python, reader):
        case FunctionInfo(asynchronous=True):
            wrong: str | None = "is `async`, which is never waited for"
        case FunctionInfo(signature=taken) | ClassInfo(constructor=taken):
            wrong = _in_order(taken, given) if taken is not None else None
        case Other():
            wrong = "is not a function"
        case Unclear():
            return
        case problem:
            yield replace(problem, severity="warning")
            return
    if wrong:
        label = Label(declared.name.span, f"the function has {_format_names(given)}")
        yield _wrong_parameters(declared.python, wrong, f"let it take the world and {_format_names(given)}", label)


def _in_order(taken: PythonSignature, given: Sequence[str]) -> str | None:
    """Return why a function cannot be called with the world and these values in order, None if it can."""
    if not taken.by_position and not taken.args:
        return "takes no world as its first value"
    left = taken.without_first(1)
    names = left.by_position
    if by_name := [name for name in left.needed if name in left.by_name]:
        return f"takes {_format_names(by_name)} by name only, and all values are passed in order"
    if len(given) < len(left.needed) or (len(given) > len(names) and not left.args):
        return f"takes {_format_names(names)} after the world, {len(names)} in number"
    if any(name != own and name in names for name, own in zip(given, names, strict=False)):
        return f"takes {_format_names(names)} after the world, in this order"
    return None


def _found(written: s.Text, reader: _Reader) -> ClassInfo | FunctionInfo | Other | Unclear | Diagnostic:
    """Return what the target is, or a diagnostic."""
    target = split_target(written.value)
    if target is None:
        return Unclear()
    module, name = target
    found = reader(module, name)
    match found:
        case NoModule(installed=True):
            return _missing(written, f"there is no Python module `{module}`", "make the file, or correct the name")
        case NoModule():
            message = f"the Python module `{module}` is not installed here, so it cannot be checked"
            help_ = "install it where the skill is checked and run, or correct the name"
            return _missing(written, message, help_)
        case BrokenModule(line=line, message=why):
            message = f"the Python module `{module}` is not valid Python: {why} (line {line})"
            return _missing(written, message, "correct it", "error")
        case NoName(there=there):
            message = f"the Python module `{module}` has no `{name}`"
            return _missing(
                written, message, did_you_mean(name, there) or "write it there, or correct the name", "error"
            )
        case _:
            return found


def _missing(written: s.Text, message: str, help_: str, severity: Severity = "warning") -> Diagnostic:
    """Report that a name is not there: an error where the module can be read, so that it certainly is not."""
    return Diagnostic("missing-python", written.span, message, help_, severity)


def _not_a_primitive(written: s.Text, what: str, help_: str) -> Diagnostic:
    return Diagnostic("not-a-primitive", written.span, f"`{_name(written)}` {what}", help_, "warning")


def _wrong_parameters(written: s.Text, takes: str, help_: str, label: Label) -> Diagnostic:
    message = f"`{_name(written)}` {takes}"
    return Diagnostic("wrong-python-parameters", written.span, message, help_, "warning", (label,))


def _name(written: s.Text) -> str:
    return written.value.partition(":")[2]


def _format_names(names: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in names) or "nothing else"
