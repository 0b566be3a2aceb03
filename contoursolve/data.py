"""Plain data as JSON."""

import json
from typing import Any


def json_text(data: Any) -> str:
    """One document: ASCII, which every console prints; a number that JSON does not know raises ValueError."""
    return json.dumps(data, indent=1, ensure_ascii=True, allow_nan=False)
