"""Parameters that can be learned: those with a range whose default a run has used."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal

import msgspec

from skillc.errors import RequestError
from skillc.services.library.files import LibraryFiles
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_dsl.syntax.conditions import Quantity
from skillc_dsl.syntax.declarations import ImplementationDeclaration, SkillDeclaration
from skillc_dsl.syntax.members import Parameter as WrittenParameter
from skillc_dsl.syntax.members import Refinement
from skillc_dsl.units import UNITS, from_si, to_si
from skillc_model.conditions import Literal
from skillc_model.skills import Implementation, Parameter, SkillLibrary
from skillc_rdf.vocabulary.types import NumberType
from skillc_runtime.evaluation.trials.settings import Setting
from skillc_runtime.recording.events import Event, ImplementationChosen

DIGITS = 3
"""How many digits a value has that is tried, and written."""
DECADE = 10.0
"""The ratio of the ends of a range from which on it is searched on a logarithmic scale."""
INT = "Int"


class Learnable(msgspec.Struct, frozen=True, kw_only=True):
    """A parameter of an implementation, `Skill.name`, with a range; numbers in `unit`, of the `type` of the text.

    `path` is the file of the implementation, as the library names it.
    """

    implementation: str
    parameter: str
    low: float
    high: float
    default: float
    unit: str
    type: str
    path: str

    @property
    def whole(self) -> bool:
        """Whether it is a whole number."""
        return self.type == INT

    @property
    def name(self) -> str:
        """Its name in full: `Wipe.wipe_lanes.speed`."""
        return f"{self.implementation}.{self.parameter}"

    @property
    def is_logarithmic(self) -> bool:
        """Whether its range spans a decade or more."""
        return self.low > 0.0 and self.high >= DECADE * self.low * (1.0 - 1e-9)

    def round(self, value: float) -> float:
        """Return the nearest value that is tried: with DIGITS digits, and within the range."""
        shortened = float(f"{value:.{DIGITS}g}")
        return min(max(shortened, self.low), self.high)

    def write(self, value: float) -> str:
        """Return a value as it is written in a text: `0.13 m/s`."""
        number = f"{Decimal(repr(value)).normalize():f}" if not self.whole else str(int(value))
        return f"{number} {self.unit}".rstrip()

    def set_to(self, value: float) -> Setting:
        """Return the setting with a value, in SI units as the compiler reads it."""
        return Setting(self.implementation, self.parameter, int(value) if self.whole else self._si(value))

    def _si(self, value: float) -> float:
        return to_si(value, self.unit) if self.unit else value


def find_learnable(library: SkillLibrary, files: LibraryFiles, events: Iterable[Event]) -> tuple[Learnable, ...]:
    """Return the parameters with a range whose defaults a run has used, in the order in which it did."""
    found: dict[str, Learnable] = {}
    for event in events:
        if isinstance(event, ImplementationChosen):
            implementation = library.implementations[f"{event.skill}.{event.implementation}"]
            used = {reason.parameter for reason in event.determined if reason.how == "default"}
            for each in _list_learnable(implementation, used, files):
                found.setdefault(each.name, each)
    return tuple(found.values())


def choose_learnable(
    learnable: Sequence[Learnable], asked: Sequence[str], files: LibraryFiles
) -> tuple[Learnable, ...]:
    """Return those of the names asked for: `speed`, `Wipe.speed`, `Wipe.wipe_lanes.speed`.

    Without names, those of implementations in the library's own files. RequestError if there are none, or a name fits
    none or several; it lists what there is.
    """
    if not learnable:
        raise RequestError("nothing can be learned: the task uses the default of no parameter with a range")
    if asked:
        return tuple(dict.fromkeys(_find(learnable, name) for name in asked))
    paths = {source.path for source in files.sources}
    own = tuple(each for each in learnable if each.path in paths)
    if not own:
        raise RequestError(
            "the task uses no defaults of implementations of its own library; name parameters of others: "
            f"{_list(learnable)}"
        )
    return own


def read_learnable_sources(files: LibraryFiles) -> Mapping[str, Source]:
    """Return the texts in which implementations may stand, by their paths in the library."""
    return {each.path: each for each in (*files.importable.values(), *files.sources)}


def _list_learnable(implementation: Implementation, used: set[str], files: LibraryFiles) -> Iterator[Learnable]:
    for each in implementation.parameters:
        if each.name not in used or each.low is None or each.high is None or each.low >= each.high:
            continue
        if isinstance(each.default, Literal) and not isinstance(each.default.value, bool | str):
            yield _make_learnable(implementation, each, each.default.value, files)


def _make_learnable(
    implementation: Implementation, parameter: Parameter, default: float, files: LibraryFiles
) -> Learnable:
    assert parameter.low is not None and parameter.high is not None
    unit = _find_unit(implementation, parameter, files)
    low, high, middle = (_in_unit(value, unit) for value in (parameter.low, parameter.high, default))
    return Learnable(
        implementation=f"{implementation.skill}.{implementation.name}",
        parameter=parameter.name,
        low=low,
        high=high,
        default=middle,
        unit=unit,
        type=parameter.type.dimension if isinstance(parameter.type, NumberType) else INT,
        path=implementation.source.path,
    )


def _find_unit(implementation: Implementation, parameter: Parameter, files: LibraryFiles) -> str:
    """Return the unit in which the author wrote the default: in the refinement, else in the skill; empty for none."""
    sources = read_learnable_sources(files)
    for path in dict.fromkeys((implementation.source.path, parameter.source.path)):
        for declared in parse(sources[path]).value.declarations:
            members = _members_of(declared, implementation, parameter)
            for default in (each.default for each in members if each.name.text == parameter.name):
                if isinstance(default, Quantity):
                    return default.unit
    if isinstance(parameter.type, NumberType):
        return next(
            (n for n, u in UNITS.items() if u.dimension.name == parameter.type.dimension and u.in_si == 1.0), ""
        )
    return ""


def _members_of(
    declared: object, implementation: Implementation, parameter: Parameter
) -> Sequence[WrittenParameter | Refinement]:
    match declared:
        case ImplementationDeclaration() if declared.span.line == implementation.source.line:
            return [each for each in declared.members if isinstance(each, Refinement)]
        case SkillDeclaration() if declared.name.text == implementation.skill:
            return [each for each in declared.members if isinstance(each, WrittenParameter)]
    return ()


def _in_unit(value: float, unit: str) -> float:
    """Return a value in SI units in the author's unit, as short as it was written."""
    return from_si(value, unit) if unit else float(value)


def _find(learnable: Sequence[Learnable], name: str) -> Learnable:
    fitting = [each for each in learnable if _fits(name.split("."), each.name.split("."))]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        raise RequestError(f"`{name}` may be {' or '.join(f'`{each.name}`' for each in fitting)}: name one of them")
    raise RequestError(f"`{name}` is no parameter that can be learned here; there are {_list(learnable)}")


def _fits(asked: Sequence[str], whole: Sequence[str]) -> bool:
    """Whether the parts asked for occur in a name in this order, the last one at its end."""
    rest = iter(whole)
    return asked[-1] == whole[-1] and all(part in rest for part in asked)


def _list(learnable: Sequence[Learnable]) -> str:
    return ", ".join(f"`{each.name}`" for each in learnable)
