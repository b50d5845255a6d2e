"""The report of one run: `summary` makes the result, `table` and `page` show it, `write` writes the files.

Start at `summary`.
"""
