"""Checks claimed results against the words of their program.

It reads programs with the same tables as the solver, and shares none of its equations and formulas: one table says what
each kind of constraint means, for every form of every control.
"""

from contoursolve.verification.decode import CannotVerifyError, Document, document_of_blocks, read_document
from contoursolve.verification.receipt import ContourReceipt, Receipt, Verdict, report_lines, to_json
from contoursolve.verification.walk import verify

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
