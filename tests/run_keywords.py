"""The keyword arguments of programs that run something, as typed dictionaries: `python tests/accept.py` writes them."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec
from msgspec import inspect

from skillc.contract.learning import LearnSpec
from skillc.contract.order import OrderRequest
from skillc_runtime.recording.documented import DocumentedField, documented_fields
from skillc_runtime.recording.run_spec import ATTENDED_ELSEWHERE, RunRequest, RunSpec, TaskRequest

FILE = Path(__file__).parents[1] / "app/skillc/values/run_keywords.py"
TARGET, PLACE = TaskRequest.__struct_fields__, ("scene", "library")
ATTENDED = ("pace", "step", "breakpoints", "confirm_steps")
"""What only makes sense where somebody operates the run."""
HEAD = '''"""The keyword arguments with which programs run something, made from its specification; do not edit.

`python tests/accept.py` writes this file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, Literal, TypedDict

from skillc.values.arguments import AnyPath
'''


def format_keywords() -> str:
    """Return the text of the file."""
    work = _select(RunSpec, without=(*TARGET, *PLACE, *ATTENDED, *ATTENDED_ELSEWHERE))
    orders = [each for each in msgspec.structs.fields(OrderRequest) if each.name not in ("request", "at")]
    submitted = _select(RunRequest, without=("task", *ATTENDED))
    dicts = (
        ("WorkKeywords", "How something is run, and what is written of it", "TypedDict", work),
        ("AttendedKeywords", "How who runs something attends to it", "TypedDict", _select(RunSpec, ATTENDED)),
        ("RunKeywords", "What is run, and how", "WorkKeywords", _select(RunSpec, (*TARGET[1:], *PLACE))),
        ("StartKeywords", "What is started, and how", "RunKeywords, AttendedKeywords", []),
        ("SceneRunKeywords", "What is run in a scene, and how", "WorkKeywords", _select(RunSpec, ("call",))),
        ("SceneStartKeywords", "What is started in a scene, and how", "SceneRunKeywords, AttendedKeywords", []),
        ("SubmitKeywords", "What a cell of a server is given", "TypedDict", submitted),
        ("OperationKeywords", "What is started in a cell", "SubmitKeywords", _select(RunRequest, ATTENDED)),
        ("LearnKeywords", "What is learned, and from how many trials", "TypedDict", _select(LearnSpec)),
    )
    texts = [_format_dict(*each) for each in dicts]
    times = "\n".join(f"    {each.name}: {_name_type(inspect.type_info(each.type))}" for each in orders)
    order = "What is started in a cell at a time, and when again; `missed` is what becomes of one that was not possible"
    texts.append(f'class OrderKeywords(SubmitKeywords, total=False):\n    """{order}."""\n\n{times}\n')
    return "\n\n".join((HEAD, *texts))


def _select(
    struct: type[msgspec.Struct], only: Iterable[str] | None = None, without: Iterable[str] = ()
) -> list[DocumentedField]:
    fields = documented_fields(struct)
    return [each for each in fields if each.name not in tuple(without) and (only is None or each.name in tuple(only))]


def _format_dict(name: str, what: str, bases: str, fields: list[DocumentedField]) -> str:
    lines = "\n".join(line for each in fields for line in _format_field(each))
    return f'class {name}({bases}, total=False):\n    """{what}."""\n' + (f"\n{lines}\n" if lines else "")


def _format_field(field: DocumentedField) -> Iterator[str]:
    kind = "AnyPath" if field.is_path else _name_type(field.type)
    yield f"    {field.name}: {kind}{' | None' if field.default is None else ''}"
    yield textwrap.fill(f'"""{field.text}"""', 116, initial_indent=" " * 4, subsequent_indent=" " * 4)


def _name_type(kind: inspect.Type) -> str:
    """Return the annotation of a keyword: it takes whatever can be read as a value of the field."""
    match kind:
        case inspect.Metadata(type=inner):
            return _name_type(inner)
        case inspect.UnionType(types=types):
            return " | ".join(map(_name_type, types))
        case inspect.NoneType():
            return "None"
        case inspect.LiteralType(values=values):
            return f"Literal[{', '.join(map(_quote, values))}]"
        case inspect.VarTupleType(item_type=item):
            return f"Sequence[{_name_type(item)}]"
        case inspect.DictType():
            return "Mapping[str, Any] | None"
        case _:
            return type(kind).__name__.removesuffix("Type").lower()


def _quote(value: object) -> str:
    return f'"{value}"'
