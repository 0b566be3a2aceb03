"""Records with some fields changed, whichever library made them."""

import dataclasses
from typing import Any

from msgspec import Struct, structs


def replace(record: Any, **changes: Any) -> Any:
    """A record with some fields changed; those of the tests are dataclasses, most of the package are not."""
    change = structs.replace if isinstance(record, Struct) else dataclasses.replace
    return change(record, **changes)
