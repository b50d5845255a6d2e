"""From a compiled library, a world and a goal to a finished task."""
