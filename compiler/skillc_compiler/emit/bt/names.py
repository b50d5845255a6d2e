"""Valid names in BehaviorTree.CPP and Groot2 for nodes, trees, ports and blackboard entries."""

from __future__ import annotations

import re

REGISTERED = """
    AlwaysFailure AlwaysSuccess AsyncFallback AsyncSequence Delay Fallback ForceFailure ForceSuccess IfThenElse Inverter
    KeepRunningUntilFailure LoopBool LoopDouble LoopInt LoopString ManualSelector Parallel ParallelAll Precondition
    ReactiveFallback ReactiveSequence Repeat RetryUntilSuccessful RunOnce Script ScriptCondition Sequence SequenceStar
    SequenceWithMemory SetBlackboard SkipUnlessUpdated Sleep SubTree Switch2 Switch3 Switch4 Switch5 Switch6 Timeout
    TryCatch UnsetBlackboard WaitValueUpdate WasEntryUpdated WhileDoElse
"""
"""The result of `builtinNodes()` in versions 4.8.2 and 4.10.0, and the nodes of all build options."""
KEPT = "Action BehaviorTree Condition Control Decorator Root TestNode TreeNodesModel Undefined include root"
"""Names that have another meaning in the format."""
BUILT_IN = frozenset((REGISTERED + KEPT).split())
ILLEGAL = re.compile(r"_(?=x[0-9a-f]+_)|[^A-Za-z0-9_]")
NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
HEADLESS = re.compile(r"n*[0-9_]|$")
RESERVED = re.compile(r"(ID|name)_*")
MADE = re.compile(r".*__(\d+|given)_*")


def to_identifier(name: str) -> str:
    """Return the name with only ASCII letters, digits and `_`, starting with a letter; the mapping is injective.

    Any other character is replaced by its code, as in `_xe4_`.
    """
    plain = ILLEGAL.sub(lambda found: f"_x{ord(found.group()):x}_", name)
    return f"n{plain}" if HEADLESS.match(plain) else plain


def to_xml_text(text: str) -> str:
    """Return the text with characters that XML does not allow replaced by U+FFFD."""
    return NOT_IN_XML.sub("\ufffd", text)


def port_name(name: str) -> str:
    """Return the name of a port, which is also the name of its blackboard entry; the mapping is injective.

    A `_` is appended to names reserved by the format and names like those of `entry_name` and `given_port`.
    """
    plain = to_identifier(name)
    return f"{plain}_" if RESERVED.fullmatch(plain) or MADE.fullmatch(plain) else plain


def entry_name(name: str, number: int) -> str:
    """Return the name of a blackboard entry, different from those of all parameters."""
    return f"{to_identifier(name)}__{number}"


def given_port(name: str) -> str:
    """Return the name of the port through which a caller passes an otherwise inferred parameter."""
    return f"{to_identifier(name)}__given"


class NodeIds:
    """Assigns unique IDs; a name that is used already or is a node of BehaviorTree.CPP is numbered."""

    def __init__(self) -> None:
        self._chosen: dict[tuple[str, ...], str] = {}
        self._used = set(BUILT_IN)

    def of(self, *parts: str) -> str:
        """Return the ID for a path of names, always the same; empty names only distinguish paths."""
        if parts not in self._chosen:
            wanted = to_identifier("_".join(filter(None, parts)))
            name, number = wanted, 1
            while name in self._used:
                number += 1
                name = f"{wanted}_{number}"
            self._used.add(name)
            self._chosen[parts] = name
        return self._chosen[parts]
