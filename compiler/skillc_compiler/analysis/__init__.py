"""Symbolic execution of compound bodies: what holds at each node for every way in which its children may end.

A state (`state.py`) is knowledge: relations, values and other conditions that are known to hold or not to; what is
not in it is open. Names are symbolic individuals. Two of them may be the same unless their classes are disjoint or a
condition tells them apart (`sorts.py`), and a write takes away all knowledge that it may have made untrue
(`writing.py`, `forgetting.py`), by the axioms of its relation (`axioms.py`): functional relations replace, inverses
and sub-relations follow, and chains of a transitive relation are left open. `truth.py` evaluates a condition to true,
false or open, `learning.py` takes in what was seen.

A body begins with what its preconditions, holds and ranges promise (`opening.py`). `exploring.py` goes through its
nodes and returns for each the states after success, after failure, and after a failure by a hold, each with the
shortest way there (`trail.py`). A called skill that succeeds has done what its posts say, and what its body may have
changed besides is forgotten; one that fails or is halted may have changed anything that it can write
(`summaries.py`). Children of a `par` know only what none of the others may write (`beside.py`). Up to LIMIT states
are told apart at a node, and loops are followed for ROUNDS; beyond, only what all have in common is known, and that
is said.

The rule for a precondition of a called skill: an error where it is false on a way, a warning where it is open and
every term is the caller's; nothing where the skill finds the individual by itself, or where the failure is caught,
unless it is false on every way. Holds of called skills, which speak of the world outside, are told only where they
are false.

What is proved speaks of runs in which only the body changes the facts it speaks of, and no primitive breaks by a
program error. `proving.py` is the entrance; the checks tell its findings (`findings.py`); `watching.py` decides
`verify` lines."""
