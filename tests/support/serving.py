"""Servers that a test starts on this machine."""

import time
import urllib.error
import urllib.request

SECONDS = 40
"""Until a server has to answer, or to end."""


def wait_for(address, server, log):
    """Wait until a server answers at an address; fail with its log if it ends before."""
    for _ in range(SECONDS * 5):
        assert server.poll() is None, log.read_text()
        try:
            with urllib.request.urlopen(address, timeout=SECONDS):
                return
        except urllib.error.URLError:
            time.sleep(0.2)
    raise AssertionError(log.read_text())
