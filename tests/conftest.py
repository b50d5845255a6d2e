"""What holds for all tests."""

import signal


def pytest_configure() -> None:
    """Let processes that tests start listen to Ctrl-C, even where the tests run in the background and do not."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
