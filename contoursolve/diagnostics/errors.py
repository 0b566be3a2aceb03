"""Errors that somebody can mend who asked for something; commands print the message alone."""


class UserError(Exception):
    """What was asked for cannot be done; the message says why, and what to do."""


class ProgramError(UserError):
    """The same about a program, whose name stands before the message where there are several."""
