"""Names that BehaviorTree.CPP and Groot2 take: for nodes and trees, for ports, for entries of the blackboard."""

from __future__ import annotations

import re

BUILT_IN = """
    Action AlwaysFailure AlwaysSuccess AsyncFallback AsyncSequence BehaviorTree Condition Control Decorator Delay
    Fallback ForceFailure ForceSuccess IfThenElse Inverter KeepRunningUntilFailure LoopBool LoopDouble LoopInt
    LoopString ManualSelector Parallel ParallelAll Precondition ReactiveFallback ReactiveSequence Repeat
    RetryUntilSuccessful RunOnce Script ScriptCondition Sequence SequenceWithMemory SetBlackboard SkipUnlessUpdated
    Sleep SubTree Switch2 Switch3 Switch4 Switch5 Switch6 Timeout TreeNodesModel UnsetBlackboard WaitValueUpdate
    WasEntryUpdated WhileDoElse root
"""
RESERVED_PORTS = frozenset({"ID", "name"})


def legal(name: str) -> str:
    """Return the name with `_` for whatever is no letter, digit or `_`; it starts with a letter."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return plain if plain[:1].isalpha() else f"n{plain}"


def port(name: str) -> str:
    """Return the name of a port, which is also that of the entry of the blackboard."""
    plain = legal(name)
    return f"{plain}_" if plain in RESERVED_PORTS else plain


class Names:
    """Gives each thing an ID of its own: its name if that is free and no node of BehaviorTree.CPP is called so."""

    def __init__(self) -> None:
        self._chosen: dict[tuple[str, ...], str] = {}
        self._used = set(BUILT_IN.split())

    def of(self, *parts: str) -> str:
        """Return the ID of the thing with this path of names, always the same."""
        if parts not in self._chosen:
            wanted = legal("_".join(parts))
            name, number = wanted, 1
            while name in self._used:
                number += 1
                name = f"{wanted}_{number}"
            self._used.add(name)
            self._chosen[parts] = name
        return self._chosen[parts]
