"""Reads planning domains back with the package `pddl`, which knows nothing of skillc: an independent check."""

from __future__ import annotations

import re
import sys

from lark.exceptions import LarkError
from pddl.exceptions import PDDLParsingError, PDDLValidationError
from pddl.parser.domain import DomainParser

from skillc_model.pddl.planning import make_planning_domain
from skillc_model.skills import SkillLibrary

_TYPES = re.compile(r"^\s*\(:types\b([^()]*)\)", re.MULTILINE)


class InvalidDomain(Exception):
    """An independent parser rejects the printed domain: a bug in the compiler."""


def read_back_artifact(library: SkillLibrary, text: str) -> None:
    """Parse the `domain.pddl` of a library; InvalidDomain unless it is valid and has the actions of its skills."""
    read_back(text, {action.name for action in make_planning_domain(library).actions})


def read_back(text: str, actions: set[str]) -> None:
    """Parse the domain with the `pddl` package; InvalidDomain unless it is valid and has exactly these actions.

    The package requires :numeric-fluents for static cost functions and Fast Downward rejects it, so it is added for the
    package only. Its cycle check is cubic in the depth of the type hierarchy, so the hierarchy is checked here and the
    package gets a flat one. It sets `sys.tracebacklimit` and does not restore it on errors, so it is restored here.
    """
    shown = _flattened(text).replace(":action-costs)", ":action-costs :numeric-fluents)", 1)
    limit = getattr(sys, "tracebacklimit", None)
    try:
        read = DomainParser()(shown)
    except (LarkError, PDDLParsingError, PDDLValidationError) as error:
        raise InvalidDomain(f"the domain printed for this library is not PDDL: {error}") from error
    finally:
        sys.tracebacklimit = limit
    if {action.name for action in read.actions} != actions:
        raise InvalidDomain("the domain printed for this library lost an action")


def _flattened(text: str) -> str:
    """Return the domain with all types directly below `object`.

    InvalidDomain unless each type is declared exactly once, below a type declared before it, which rules out cycles.
    """
    found = _TYPES.search(text)
    if not found:
        return text
    declared, names = {"object"}, list[str]()
    tokens = iter(found[1].split())
    for token in tokens:
        if token != "-":
            names.append(token)
            continue
        parent = next(tokens, "")
        if parent not in declared:
            raise InvalidDomain(f"the domain printed for this library has types below an undeclared one: `{parent}`")
        if len(declared | {*names}) < len(declared) + len(names):
            raise InvalidDomain(f"the domain printed for this library declares a type twice: {', '.join(names)}")
        declared.update(names)
        names.clear()
    if names:
        raise InvalidDomain(f"the domain printed for this library has types without a parent: {', '.join(names)}")
    flat = " ".join(sorted(declared - {"object"}))
    return f"{text[: found.start(1)]} {flat} - object {text[found.end(1) :]}"
