"""What holds for every test."""

import signal

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # A shell ignores interrupts in what it starts in the background, and so would every child of a test.
    signal.signal(signal.SIGINT, signal.default_int_handler)
