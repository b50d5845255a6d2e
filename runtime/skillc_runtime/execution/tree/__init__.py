"""The behaviour tree engine: nodes that start, tick, halt, pause and undo.

Start reading at `run`, then `node` for the life cycle and `active_path` for why a tick costs so little.
"""
