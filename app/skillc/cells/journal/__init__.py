"""The journal of a cell: what happened and what changed in the world, durable before anything moves because of it.

Start at `journal`, the writer; `reading` reads it from other processes, `schema` has the tables and their formats.
"""
