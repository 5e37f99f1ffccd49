"""Exceptions of the module, one for each kind of error that the library has."""

__all__ = ["Cancelled", "Error", "InternalError", "NoUsableGpu", "OutputNotWritten", "UnusableFile", "UsageError"]


class Error(Exception):
    """What the library has to say: `str(error)` is its message, in one line.

    file: the file concerned, as it was given, or ""; line: from 1 on, or 0; json_path: such as
    "meshes[0].primitives[1]", or ""; problem: what is wrong; advice: what to do, or "".
    """

    def __init__(self, message: str, file: str = "", line: int = 0, json_path: str = "", problem: str = "", advice: str = "") -> None:
        super().__init__(message, file, line, json_path, problem, advice)
        self.file = file
        self.line = line
        self.json_path = json_path
        self.problem = problem or message
        self.advice = advice

    def __str__(self) -> str:
        return str(self.args[0])


class InternalError(Error):
    """Our own fault: please report it."""


class UsageError(Error, ValueError):
    """A call that makes no sense."""


class UnusableFile(Error):
    """A file that was given cannot be used."""


class NoUsableGpu(Error):
    """No device fulfils the requirements, or it was lost, or is out of memory."""


class OutputNotWritten(Error):
    """The output cannot be written."""


class Cancelled(Error):
    """A progress callable returned False."""
