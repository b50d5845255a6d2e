"""What services need to report, whatever they do: messages, files, internal errors, the environment."""
