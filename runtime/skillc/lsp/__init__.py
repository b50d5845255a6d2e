"""The language server: the protocol around `skillc_compiler.assist`, and the libraries that are being edited."""
