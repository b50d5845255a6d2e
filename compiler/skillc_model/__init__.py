"""The compiled library: the one contract between the compiler and the runtime."""
