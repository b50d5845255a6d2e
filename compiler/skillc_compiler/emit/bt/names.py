"""Names that BehaviorTree.CPP and Groot2 take: for nodes and trees, for ports, for entries of the blackboard."""

from __future__ import annotations

import re

REGISTERED = """
    AlwaysFailure AlwaysSuccess AsyncFallback AsyncSequence Delay Fallback ForceFailure ForceSuccess IfThenElse Inverter
    KeepRunningUntilFailure LoopBool LoopDouble LoopInt LoopString ManualSelector Parallel ParallelAll Precondition
    ReactiveFallback ReactiveSequence Repeat RetryUntilSuccessful RunOnce Script ScriptCondition Sequence SequenceStar
    SequenceWithMemory SetBlackboard SkipUnlessUpdated Sleep SubTree Switch2 Switch3 Switch4 Switch5 Switch6 Timeout
    TryCatch UnsetBlackboard WaitValueUpdate WasEntryUpdated WhileDoElse
"""
"""What `builtinNodes()` of versions 4.8.2 and 4.10.0 returns, and the nodes of all build options."""
KEPT = "Action BehaviorTree Condition Control Decorator Root TestNode TreeNodesModel Undefined include root"
"""What the format itself has another meaning for."""
BUILT_IN = frozenset((REGISTERED + KEPT).split())
ILLEGAL = re.compile(r"_(?=x[0-9a-f]+_)|[^A-Za-z0-9_]")
NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
HEADLESS = re.compile(r"n*[0-9_]|$")
RESERVED = re.compile(r"(ID|name)_*")
MADE = re.compile(r".*__(\d+|given)_*")


def to_identifier(name: str) -> str:
    """Return the name of ASCII letters, digits and `_` only, beginning with a letter; no two names share one.

    A character that is none of these becomes its code, as in `_xe4_`.
    """
    plain = ILLEGAL.sub(lambda found: f"_x{ord(found.group()):x}_", name)
    return f"n{plain}" if HEADLESS.match(plain) else plain


def to_xml_text(text: str) -> str:
    """Return text that XML can hold: a character that it cannot becomes the replacement character."""
    return NOT_IN_XML.sub("\ufffd", text)


def port_name(name: str) -> str:
    """Return the name of a port, which is also that of the entry of the blackboard; no two names share one.

    A name that the format keeps for itself, or that looks like one that `entry` or `given` makes, gets a `_` more.
    """
    plain = to_identifier(name)
    return f"{plain}_" if RESERVED.fullmatch(plain) or MADE.fullmatch(plain) else plain


def entry_name(name: str, number: int) -> str:
    """Return the name of an entry of the blackboard that no parameter has."""
    return f"{to_identifier(name)}__{number}"


def given_port(name: str) -> str:
    """Return the port through which a caller passes what would be inferred otherwise."""
    return f"{to_identifier(name)}__given"


class NodeIds:
    """Gives each thing an ID of its own: its name if that is free and no node of BehaviorTree.CPP is called so."""

    def __init__(self) -> None:
        self._chosen: dict[tuple[str, ...], str] = {}
        self._used = set(BUILT_IN)

    def of(self, *parts: str) -> str:
        """Return the ID of the thing with this path of names, always the same; empty ones only tell paths apart."""
        if parts not in self._chosen:
            wanted = to_identifier("_".join(filter(None, parts)))
            name, number = wanted, 1
            while name in self._used:
                number += 1
                name = f"{wanted}_{number}"
            self._used.add(name)
            self._chosen[parts] = name
        return self._chosen[parts]
