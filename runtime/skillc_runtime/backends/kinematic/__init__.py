"""The cell without physics: joints follow their commands, contact is ideal, nothing has weight, slips or shakes.

Start with `cell`. It is fast, and for tests of skills: what only physics could verify stays unverified.
"""
