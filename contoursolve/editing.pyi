from .program import (
    OpenContour as OpenContour,
    changes_of as changes_of,
    find_settings as find_settings,
    find_tool_table as find_tool_table,
    likely_fixes as likely_fixes,
    mend_open as mend_open,
    safe_fixes as safe_fixes,
)
from .sketches import (
    sketch_view as sketch_view,
)
