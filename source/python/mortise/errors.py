"""Errors of the program as exceptions, by its exit code, with its own text."""

from __future__ import annotations

from typing import Any, Optional


class MortiseError(Exception):
    """A run that did not end well. The text is the program's message."""

    def __init__(self, message: str, exit_code: Optional[int] = None, results: Any = None):
        super().__init__(message)
        #: of the program; None if it was not started
        self.exit_code = exit_code
        #: what was written before the run ended, or None
        self.results = results


class ProgramNotFound(MortiseError):
    """There is no program to run."""


class ProgramDefect(MortiseError):
    """Exit code 1: a defect of the program, not of its input."""


class InputError(MortiseError):
    """Exit code 2: wrong input, or results that cannot be written."""


class NotConverged(MortiseError):
    """Exit code 3: not converged; the last result is written, see `results`."""


class OutOfMemory(MortiseError):
    """Exit code 4: the machine has too little memory."""


class Interrupted(MortiseError):
    """A signal ended the program, or the time that it was given."""


def error_of(exit_code: int, message: str, results: Any) -> MortiseError:
    """The exception for an exit code other than 0."""
    kinds = {1: ProgramDefect, 2: InputError, 3: NotConverged, 4: OutOfMemory}
    kind = Interrupted if exit_code < 0 or exit_code > 128 else kinds.get(exit_code, ProgramDefect)
    return kind(message, exit_code, results)
