"""What holds for every test."""

import signal
import sys

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # A shell ignores interrupts in what it starts in the background, and so would every child of a test.
    signal.signal(signal.SIGINT, signal.default_int_handler)

# For the syntax of IRIs jsonschema builds dozens of parsers when it is imported, which takes seconds. No test has them.
sys.modules.setdefault("rfc3987_syntax", None)
