"""Libraries of older editions compile as they did."""
