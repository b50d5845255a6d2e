"""Pictures of skills and tasks: `drawing` converts declarations to boxes, `svg` and `mermaid` draw them.

Start at `drawing`.
"""
