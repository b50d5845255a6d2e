"""What editors show beside a text: hints in its lines, and commands above its declarations."""
