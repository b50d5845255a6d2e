"""What is shown while something goes on, and the keys that operate it."""
