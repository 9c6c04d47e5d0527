"""Exceptions with the place and the key that they are about."""
from __future__ import annotations

import json
import re
from typing import NamedTuple, NoReturn


class Message(NamedTuple):
    """One error of a study or a command."""

    sentence: str  #: what is wrong and what would be right
    file: str | None  #: file that it is about
    line: int | None  #: line in that file, from 1
    column: int | None  #: column in characters, from 1
    key: str | None  #: dotted path of the key, such as ``load.mass``


class GoughError(Exception):
    """Base of all errors of this package.

    ``errors`` has every error that was found, in the order of the file; ``file``, ``line``, ``column``, ``key`` and ``sentence`` are
    those of the first.
    """

    def __init__(self, text: str, errors: list[Message]):
        super().__init__(text.rstrip("\n"))
        self.errors = errors
        first = errors[0] if errors else Message(text, None, None, None, None)
        self.sentence, self.file, self.line, self.column, self.key = first


class StudyError(GoughError, ValueError):
    """The study, the machine that it describes or an argument is invalid."""


class NumericalError(GoughError, ArithmeticError):
    """There is no answer: a singular pose, no convergence, no solution."""


class FileError(GoughError, OSError):
    """Reading or writing failed, or there was not enough memory."""


_PLACE = re.compile(
    r"^(?:(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)|--set (?P<key>\S+)|(?P<name>[^\n]*?)): error: (?P<sentence>[^\n]*)$",
    re.M,
)
_KEY = re.compile(r"`([A-Za-z_][\w]*(?:\.[\w]+)*)`|^([a-z_]+(?:\.\w+)+)")
_CLASSES = {1: NumericalError, 2: StudyError, 3: FileError}


def messages(text: str) -> list[Message]:
    """The errors in a text of the library or the command."""
    found = []
    for match in _PLACE.finditer(text):
        sentence, file, name = match["sentence"], match["file"], match["name"]
        if name and not name.startswith("gough"):
            file = name
        inner = re.match(r"(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+): (?P<sentence>.*)", sentence)
        line, column = match["line"], match["column"]
        if inner and line is None:
            file, line, column, sentence = inner["file"], inner["line"], inner["column"], inner["sentence"]
        key = _KEY.search(sentence)
        word = match["key"] or (key and (key[1] or key[2]))
        found.append(Message(sentence, file, int(line) if line else None, int(column) if column else None, word))
    return found


def _lines(said: str) -> list[tuple[str, dict | str]]:
    """For each line its kind and its object in JSON; a line that is not JSON gives "" and its text."""
    found: list[tuple[str, dict | str]] = []
    for line in said.splitlines():
        try:
            [(kind, value)] = json.loads(line).items()
            found.append((kind, value))
        except (ValueError, AttributeError):
            found.append(("", line))
    return found


def plain(said: str) -> str:
    """The errors among messages in JSON, as the command writes them without it."""
    text = []
    for kind, value in _lines(said):
        if isinstance(value, str):
            text.append(value)
        elif kind == "error":
            place = ":".join(str(value[name]) for name in ("file", "line", "column") if name in value)
            place = place or ("--set " + value["setting"] if "setting" in value else f"gough {value.get('verb', '')}".strip())
            text.append(f"{place}: error: {value['message']}")
    return "\n".join(text)


def remarks_in(said: str) -> list[str]:
    """The remarks, warnings and errors among messages in JSON, as sentences."""
    return [
        value if isinstance(value, str) else ("warning: " if kind == "warning" else "") + value["message"]
        for kind, value in _lines(said)
    ]


def fail(status: int, text: str, key: str | None = None) -> NoReturn:
    """Raises the exception for a status of the library with what it says."""
    usage = [line for line in text.splitlines() if not line.startswith("'gough ")]  # there is no command line here
    text = "\n".join(line.partition(": ")[2] if re.match(r"gough \w+: (?!error: )", line) else line for line in usage)
    found = messages(text) or [Message(text.strip(), None, None, None, key)]
    raise _CLASSES.get(status, GoughError)(text, found)
