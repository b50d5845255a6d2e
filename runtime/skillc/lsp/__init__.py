"""The language server: the protocol around `skillc_compiler.ide`, and the libraries that are being edited."""
