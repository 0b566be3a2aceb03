"""A report: one page of HTML about a whole program, for a screen or for paper."""

from contoursolve.report.page import report_page

__all__ = ["report_page"]
