"""A process that watches a run: it ends a run that is not ticked any more, and writes the end of one that died.

Start at `process`, the side of the run. What the other process runs is in `skillc_runtime.platforms`; `ending` writes
the end.
"""
