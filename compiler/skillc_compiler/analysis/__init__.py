"""Symbolic execution of compound bodies: what is known at each node, for every way in which its children can end.

Start with `proof`.

A state (`state`) is partial knowledge: relations, values and other conditions that are known to hold or not to hold.
Everything else is open. Names are symbolic individuals. Two names may denote one individual unless their classes are
disjoint or a condition distinguishes them (`alias_types`). A write removes all knowledge that it may have made untrue
(`apply_effects`, `havoc`), according to the axioms of its relation (`axioms`): functional relations replace values,
inverses and sub-relations follow, and chains of a transitive relation become open. `evaluate` evaluates a condition to
true, false or open; `assume` adds what was observed.

A body begins with what its preconditions, holds and ranges promise (`initial_state`). `nodes` explores the nodes of a
body and returns for each the states after success, after failure, and after a failure by a hold, each with the shortest
path to it (`paths`). When a called skill succeeds, its postconditions hold, and everything else that its body may have
changed becomes open. A skill that fails or is halted may have changed anything that it can write (`summaries`).
Children of a `par` know only what none of the others may write (`parallel`). At most MAX_STATES states are kept apart
at a node, and loops are followed for MAX_ROUNDS rounds; beyond that, only what all states have in common is kept, and
this is reported.

A precondition of a called skill is an error if it is false on some path, and a warning if it is open and all its terms
are the caller's. It is not reported if the skill infers the individual at run time, or if the failure is caught, unless
it is false on every path. Holds of called skills, which depend on the outside world, are only reported if they are
false.

A proof is found again only if its body, or what it reads of the skills that the body calls, has changed
(`sameness`): of a body that is called, callers read the `interfaces`, so that an edit in it that changes none of these
concerns no caller.

A proof is valid for executions in which only the body changes the facts it uses, and in which no primitive fails by a
program error. The checks report its `findings`; `verify_monitor` decides `verify` lines.
"""
