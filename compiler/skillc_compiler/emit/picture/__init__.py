"""Pictures of skills and tasks: `drawing` converts declarations to boxes, `svg`, `mermaid` and `text` draw them.

Start at `drawing`.
"""
