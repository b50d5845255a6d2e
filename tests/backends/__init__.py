"""What is expected of everything that implements `Arm`, and which implementations there are."""
