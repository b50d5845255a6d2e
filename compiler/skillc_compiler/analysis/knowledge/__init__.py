"""What is known of the world at one point of a body, and how that changes."""
