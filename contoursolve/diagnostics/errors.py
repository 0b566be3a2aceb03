"""Errors that somebody can mend who asked for something; commands print the message alone."""


class UserError(Exception):
    """A request that cannot be met; the message says why, and what to do."""


class ProgramError(UserError):
    """The same about a program, whose name stands before the message where there are several."""
