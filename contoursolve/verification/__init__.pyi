from .decode import (
    CannotVerifyError as CannotVerifyError,
    Document as Document,
    document_of_blocks as document_of_blocks,
    read_document as read_document,
)
from .receipt import (
    ContourReceipt as ContourReceipt,
    Receipt as Receipt,
    Verdict as Verdict,
    report_lines as report_lines,
    to_json as to_json,
)
from .walk import (
    verify as verify,
)
