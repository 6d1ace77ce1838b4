"""What goes wrong, in three kinds: the user's mistake, a state that does not exist, a defect of the program.

The third kind has no class of its own: it is any other exception, and worth a report.
"""


class UserError(ValueError):
    """What the user can repair; the text is one sentence: place, key, value, what is allowed, what to do."""


class InputError(UserError):
    """The user's file is missing or damaged; the text is one sentence that names it."""


class NoStateError(ArithmeticError):
    """The state that was asked for does not exist or was not reached; `result` holds the last one on the way."""

    def __init__(self, result):
        super().__init__(f"{result.status}: {result.message}")
        self.result = result


def reason(error):
    """What the operating system or a parser said, without the path that stands before it already."""
    return getattr(error, "strerror", None) or str(error)
