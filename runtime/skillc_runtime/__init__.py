"""From a compiled library, a world and a goal to an executed task.

The packages are listed in docs/architecture.md, each imports only those above it. Start at `execution.cell_loop`.
"""
