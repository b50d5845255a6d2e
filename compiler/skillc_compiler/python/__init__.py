"""What Python modules define, read from their text: nothing is imported or run."""
