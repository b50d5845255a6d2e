"""What an editor asks while somebody writes: pure functions over an understood library, no protocol."""
