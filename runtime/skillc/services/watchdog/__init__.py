"""A process that watches a run: it ends a run that is not ticked any more, and writes the end of one that died.

Start at `process`, the side of the run. `program` is what the other process runs; `ending` writes the end.
"""
