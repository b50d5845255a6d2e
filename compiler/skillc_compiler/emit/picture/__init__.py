"""Pictures of skills and tasks: `find` and `drawing` make boxes of what was written, `svg` and `mermaid` draw them."""
