"""Orders: operations that a server submits at a time, once or again and again."""
