"""Runs the command `gough` and reads what it prints and writes."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from . import _errors, _gough
from ._errors import fail
from ._study import Study


def command() -> str:
    """Path of the command: the one of this package, or if it has none the one on PATH."""
    own = os.path.join(os.path.dirname(__file__), "command", "gough")
    found = own if os.access(own, os.X_OK) else shutil.which("gough")
    if not found:
        fail(3, "the command `gough` was not found: neither in this package nor on PATH")
    return found


def number(value: Any) -> str:
    """A number as an option takes it, with all its digits."""
    return value if isinstance(value, str) else repr(float(value))


def numbers(values: Iterable[Any]) -> str:
    """Several numbers, separated by commas."""
    return ",".join(number(value) for value in values)


def pose_words(pose: Mapping[str, float]) -> str:
    """Components of a pose as the command takes them."""
    return ",".join(f"{name}={number(value)}" for name, value in pose.items())


def span(values: Sequence[Any]) -> str:
    """(from, to, number) or (from, to, number, "log") as A:B:N."""
    return ":".join(value if isinstance(value, str) else str(value) if isinstance(value, int) else number(value) for value in values)


def run(verb: str, studies: Sequence[Study | str], options: Mapping[str, Any], as_json: bool = True) -> tuple[int, Any, list[str]]:
    """Runs a verb: its exit status (0, or 1 if there is an answer in spite of a limit), its JSON and its remarks.

    Options that are None or False are left out; True is an option without a value, and a list is an option given several times.
    """
    arguments = [command(), verb]
    text = None
    for study in studies:
        if isinstance(study, str):
            arguments.append(study)
            continue
        if study.path is None:
            text = study.text.encode()
        arguments.append(study.path or "-")
    if studies and isinstance(studies[0], Study):
        arguments += [f"--set={key}={value}" for key, value in studies[0].settings.items()]
    for name, value in options.items():
        name = name.replace("_", "-")
        if value is True:
            arguments.append(f"--{name}")
        elif value is not None and value is not False:
            arguments += [f"--{name}={one}" for one in (value if isinstance(value, list) else [value])]
    if as_json:
        arguments.append("--json")
    done = subprocess.run(arguments, input=text or b"", capture_output=True, check=False)
    said = done.stderr.decode("utf-8", "replace")
    if done.returncode not in (0, 1) or (as_json and not done.stdout):
        if as_json:
            said = _errors.plain(said)
        fail(done.returncode, said.replace("standard input:", "study:") if text else said)
    remarks = [line.partition(": ")[2] for line in said.splitlines() if line.startswith("gough ")]
    if as_json:
        remarks = _errors.remarks_in(said)
    return done.returncode, json.loads(done.stdout) if as_json else done.stdout, remarks


def read_table(path: str) -> tuple[list, dict]:
    """Columns and facts of a table."""
    try:
        return _gough.table_read(path)
    except _gough.Failure as failure:
        fail(*failure.args)
