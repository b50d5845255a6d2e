"""From skill sources to a checked library and its artifacts. No clock, no network."""
