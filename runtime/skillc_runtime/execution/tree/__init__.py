"""The behaviour tree engine: grounded nodes that tick, halt, pause and undo."""
