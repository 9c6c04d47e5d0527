"""The verbs of the command as functions. Each takes a study (a path, a mapping or a `Study`) and returns a `Result`."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _command, _gough
from ._errors import fail
from ._results import End, Page, Result, from_table
from ._study import Study, StudyLike, as_study

Settings = Mapping[str, Any]
Law = Callable[[dict], Sequence[float]]


def _with_table(verb: str, study: Study, output: str | os.PathLike[str] | None, options: dict, table: bool = True) -> Result:
    """Runs a verb that writes a table, into `output` or into a file that is read and removed."""
    with tempfile.TemporaryDirectory(prefix="gough-") as folder:
        path = os.fspath(output) if output is not None else os.path.join(folder, "table.h5")
        status, summary, remarks = _command.run(verb, [study], options | ({"output": path} if table else {}))
        return from_table(verb, study, path if table and not path.endswith(".shard") else None, status, summary, remarks)


def check(study: StudyLike, *, pose: Mapping[str, float] | None = None, lengths: Sequence[float] | None = None, set: Settings | None = None) -> Result:
    """Checks a study and describes its machine.

    Parameters
    ----------
    pose
        describe this pose too, by its components from home in the units of the study: ``{"surge": 0.1, "yaw": 5}``
    lengths
        the same by six leg lengths
    set
        keys of the study to override

    Returns a `Result` without columns; ``summary`` has the keys of the guide to JSON.
    """
    read = as_study(study, set)
    status, summary, remarks = _command.run(
        "check", [read], {"pose": pose and _command.pose_words(pose), "lengths": None if lengths is None else _command.numbers(lengths)}
    )
    return Result("check", read, None, summary, status, remarks)


def _run(verb: str, study: StudyLike, set: Settings | None, law: Law | None, **options: Any) -> Result:
    read = as_study(study, set)
    precision = options.pop("precision")
    if precision not in ("double", "quad"):
        fail(2, f"`precision` is double or quad, not {precision!r}")
    asked = {"actuators": False, **options}
    try:
        table, ended = _gough.run(
            read._handle, verb, asked["dimensionless"], asked["reactions"], asked["joints"], asked["actuators"], precision == "quad", law
        )
    except _gough.Failure as failure:
        fail(*failure.args)
    end = End(ended[0], ended[1], ended[2] or None, ended[3] or None, ended[4] if ended[2] or ended[3] else None, ended[5])
    words = {"precision": "quad" if precision == "quad" else None, **options}
    summary = None if law else lambda: _command.run(verb, [read], words)[1]
    return Result(verb, read, _gough.result_columns(table), summary, 0 if end.cause == "done" else 1, None, end, table)


def forces(
    study: StudyLike,
    *,
    joints: bool = False,
    reactions: bool = False,
    dimensionless: bool = False,
    precision: str = "double",
    set: Settings | None = None,
) -> Result:
    """The leg forces that the program needs (inverse dynamics), computed in this process.

    Parameters
    ----------
    joints, reactions
        further columns: forces at the joints and side loads; reactions of the constraints
    dimensionless
        numbers in R_b, M and sqrt(R_b/g) in place of the units of the study
    precision
        ``"double"`` or ``"quad"``, 16 or 33 digits of computation; columns are float64
    set
        keys of the study to override

    Returns a `Result` with a row for each output time: columns ``t``, the pose, ``l1`` … ``l6``, ``dl1`` … ``f6`` and so on. If
    the program exceeds a limit, all rows are there and ``end`` tells the first limit.
    """
    return _run("forces", study, set, None, joints=joints, reactions=reactions, dimensionless=dimensionless, precision=precision)


def simulate(
    study: StudyLike,
    *,
    law: Law | None = None,
    joints: bool = False,
    reactions: bool = False,
    actuators: bool = False,
    dimensionless: bool = False,
    precision: str = "double",
    set: Settings | None = None,
) -> Result:
    """The motion under leg forces, control and disturbances (forward dynamics), computed in this process.

    Parameters
    ----------
    law
        a control law in Python, called at each sample of a sampled controller (``control.sampling``). It gets a dictionary, all of
        it in the units of the model (SI, or dimensionless): ``number`` and ``time`` of the sample; for the six legs ``length``
        and ``rate`` as measured, ``program_force``, ``program_length``, ``program_rate``; and ``command``, what the law of the study
        commands. It returns six drive forces, or None for those of the study. An exception in it ends the run.
    actuators, joints, reactions
        further columns: commands and limits of the drives; forces at the joints; reactions of the constraints
    dimensionless, precision, set
        as in `forces`

    Returns a `Result` with a row for each output time up to the end; ``end`` tells how the run ended.
    """
    return _run(
        "simulate", study, set, law, joints=joints, reactions=reactions, actuators=actuators, dimensionless=dimensionless, precision=precision
    )
