"""Checks claimed results against the words of their program.

It reads programs with the same tables as the solver, and shares none of its equations and formulas.
"""

from contoursolve.verification.document import CannotVerifyError, Document, document_of_blocks, read_document
from contoursolve.verification.receipt import ContourReceipt, Receipt, Verdict, to_json
from contoursolve.verification.report import report_lines
from contoursolve.verification.verify import verify

__all__ = [
    "CannotVerifyError",
    "ContourReceipt",
    "Document",
    "Receipt",
    "Verdict",
    "document_of_blocks",
    "read_document",
    "report_lines",
    "to_json",
    "verify",
]
