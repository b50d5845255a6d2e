"""What no skill can do, and what is left when something breaks."""
