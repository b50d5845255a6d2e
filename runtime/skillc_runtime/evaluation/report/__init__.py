"""What a task did, for people: `summary` makes the result, `table` and `page` show it, `write` makes the files."""
