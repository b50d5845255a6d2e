"""From a checked program to the library that the runtime loads. Start with `library`."""
