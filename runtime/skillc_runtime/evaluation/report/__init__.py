"""What a task did, for people: figures, a page, a table."""
