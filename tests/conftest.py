"""What holds for all tests."""

import sys

# For the syntax of IRIs jsonschema builds dozens of parsers when it is imported, which takes seconds. No test has them.
sys.modules.setdefault("rfc3987_syntax", None)
