"""The API itself: its endpoints as data, with examples, problems and versions."""
