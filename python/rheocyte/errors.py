"""What goes wrong, in three kinds: the user's mistake, a state that does not exist, a defect of the program.

The third kind has no class of its own: it is any other exception, and worth a report.
"""

import re

_LONGEST = 1000  # characters; a text of the user's may be any length


class UserError(ValueError):
    """What the user can repair; the text is one sentence: place, key, value, what is allowed, what to do."""

    def __init__(self, sentence=""):
        line = re.sub(r"\s*[\r\n]\s*", " ", str(sentence)).encode("utf-8", "backslashreplace").decode()
        half = _LONGEST // 2
        super().__init__(line if len(line) <= _LONGEST else f"{line[:half]} ... {line[-half:]}")


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


_EXAMPLES = re.compile(r"; for example --(?:polygon .*|m(?:in|ax) \S+)\.$")
_OPTION = re.compile(r"(?<![\w-])--([a-zA-Z][\w-]*\w)")


def in_words_of_python(sentence):
    """A sentence of the program with the names of arguments in place of options."""
    return _OPTION.sub(lambda found: found[1].replace("-", "_"), _EXAMPLES.sub(".", sentence))
