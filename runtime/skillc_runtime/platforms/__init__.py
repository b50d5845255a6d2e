"""What differs between operating systems: signals, processes, sandboxes, file locks, memory, keyboards, the watchdog.

Nothing else asks which system it runs on. A file that begins with `unix_`, and the two programs that are started as
files, need Linux or macOS; the others say what Windows does instead.
"""
