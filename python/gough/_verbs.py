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


def stability(
    study: StudyLike,
    *,
    pose: Mapping[str, float] | None = None,
    lengths: Sequence[float] | None = None,
    matrix: bool = False,
    at: float | None = None,
    sweep_stiffness: Sequence[Any] | None = None,
    sweep_damping: Sequence[Any] | None = None,
    sweep_amplitude: Sequence[Any] | None = None,
    sweep_frequency: Sequence[Any] | None = None,
    sweep_delay: Sequence[Any] | None = None,
    sweep_period: Sequence[Any] | None = None,
    modes: str | None = None,
    dimensionless: bool = False,
    threads: int | None = None,
    output: str | os.PathLike[str] | None = None,
    set: Settings | None = None,
) -> Result:
    """Whether the control law holds the platform.

    Parameters
    ----------
    pose, lengths
        at rest in this pose, by its components from home or by six leg lengths, in the units of the study
    matrix, at
        add the matrix of the linearised loop to ``summary``; about the program at the time `at`
    sweep_stiffness
        compute a map over the stiffness: (from, to, number), or (from, to, number, "log"), in the units of the study; the columns are
        those of the map
    sweep_damping, sweep_amplitude, sweep_frequency, sweep_delay, sweep_period
        second axis of the map, at most one of them
    modes
        map only modes that move in nothing but these: ``"heave"``, ``"sway+tilt"`` …
    output
        write the map to this file (.h5 or .csv)
    dimensionless, threads, set
        as in `forces`; threads of a map

    Returns a `Result`; an unstable loop is an answer, not an error.
    """
    read = as_study(study, set)
    axes = {
        "sweep_stiffness": sweep_stiffness,
        "sweep_damping": sweep_damping,
        "sweep_amplitude": sweep_amplitude,
        "sweep_frequency": sweep_frequency,
        "sweep_delay": sweep_delay,
        "sweep_period": sweep_period,
    }
    options = {
        "pose": pose and _command.pose_words(pose),
        "lengths": None if lengths is None else _command.numbers(lengths),
        "matrix": matrix,
        "at": None if at is None else _command.number(at),
        **{name: None if value is None else _command.span(value) for name, value in axes.items()},
        "modes": modes,
        "dimensionless": dimensionless,
        "threads": threads,
    }
    return _with_table("stability", read, output, options, table=sweep_stiffness is not None)


def tune(
    study: StudyLike,
    *,
    deviation: float | None = None,
    angle_deviation: float | None = None,
    damping_ratio: float | None = None,
    feedforward: str | None = None,
    margin: float | None = None,
    stiffness: Sequence[float] | None = None,
    poles: Sequence[float] | None = None,
    lqr: Sequence[float] | None = None,
    pose: Mapping[str, float] | None = None,
    dimensionless: bool = False,
    threads: int | None = None,
    output: str | os.PathLike[str] | None = None,
    set: Settings | None = None,
) -> Result:
    """The least stiffness of the feedback with which the platform stays close to its program.

    Parameters
    ----------
    deviation, angle_deviation
        greatest distance and angle from the program that are allowed, in the units of the study
    damping_ratio
        choose the damping too, for this ratio of the least damped mode at home
    feedforward
        ``"program"``, ``"none"`` or ``"both"``
    margin
        distance to instability, as a fraction of the stiffness
    stiffness
        (least, greatest) stiffness to search
    poles, lqr, pose
        instead of a search matrices of gains: (frequency, damping ratio) of all modes, or the weights (Q1, Q2); in a pose
    dimensionless, threads, output, set
        as in `stability`; `output` is for the curve of the search

    Returns a `Result` whose columns are the curve of deviation over stiffness; ``summary["choices"]`` has the stiffness found.
    """
    read = as_study(study, set)
    gains = poles is not None or lqr is not None
    options = {
        "deviation": None if deviation is None else _command.number(deviation),
        "angle_deviation": None if angle_deviation is None else _command.number(angle_deviation),
        "damping_ratio": None if damping_ratio is None else _command.number(damping_ratio),
        "feedforward": feedforward,
        "margin": None if margin is None else _command.number(margin),
        "stiffness": None if stiffness is None else _command.span(stiffness),
        "poles": None if poles is None else _command.numbers(poles),
        "lqr": None if lqr is None else _command.numbers(lqr),
        "pose": pose and _command.pose_words(pose),
        "dimensionless": dimensionless,
        "threads": threads,
    }
    return _with_table("tune", read, output, options, table=not gains)


def sweep(
    study: StudyLike,
    *,
    output: str | os.PathLike[str] | None = None,
    forces: bool = False,
    sizing: bool = False,
    shard: tuple[int, int] | None = None,
    dimensionless: bool = False,
    lanes: int | None = None,
    threads: int | None = None,
    set: Settings | None = None,
) -> Result:
    """Many runs of a study, with the numbers that its section `sweep` varies.

    Parameters
    ----------
    output
        file of the table (.h5, .csv, or .shard with `shard`); a sweep that was stopped resumes from it
    forces
        the forces along the program in place of simulations
    sizing
        add columns for sizing the legs
    shard
        (I, N): the I-th of N parts only, into `output`, for `merge`; the result then has no columns
    lanes, threads
        runs side by side in a thread; threads
    dimensionless, set
        as in `forces`

    Returns a `Result` with a row for each run.
    """
    read = as_study(study, set)
    if shard is not None and output is None:
        fail(2, "a shard needs `output`, a file whose name ends in .shard")
    options = {
        "forces": forces,
        "sizing": sizing,
        "shard": shard and f"{shard[0]}/{shard[1]}",
        "dimensionless": dimensionless,
        "lanes": lanes,
        "threads": threads,
    }
    return _with_table("sweep", read, output, options)


def merge(shards: Sequence[str | os.PathLike[str]], output: str | os.PathLike[str] | None = None) -> Result:
    """Joins the shards of a sweep, in any order, into the table of the whole sweep; `output` keeps it in a file (.h5 or .csv)."""
    with tempfile.TemporaryDirectory(prefix="gough-") as folder:
        path = os.fspath(output) if output is not None else os.path.join(folder, "table.h5")
        status, summary, remarks = _command.run("merge", [os.fspath(shard) for shard in shards], {"output": path})
        return from_table("merge", None, path, status, summary, remarks)


def pose(
    study: StudyLike,
    *,
    lengths: Sequence[float] | None = None,
    near: Mapping[str, float] | None = None,
    all: bool = False,
    samples: str | os.PathLike[str] | None = None,
    length_error: float | None = None,
    output: str | os.PathLike[str] | None = None,
    set: Settings | None = None,
) -> Result:
    """The pose from six leg lengths, with a certificate.

    Parameters
    ----------
    lengths
        six lengths, joint to joint, in the unit of the study
    near
        the pose joined to this one in place of home, by its components from home
    all
        every pose of these lengths
    samples, length_error
        the poses of a record of lengths, a file with the columns t and l1 … l6, whose lengths have this greatest error; the
        result then has a row for each row of the record
    output
        keeps the table of a record in a file
    set
        as in `forces`

    Returns a `Result`; ``summary["poses"]`` has the poses. If no pose can be certified, ``status`` is 1 and
    ``summary["message"]`` says why.
    """
    read = as_study(study, set)
    options = {
        "lengths": None if lengths is None else _command.numbers(lengths),
        "near": near and _command.pose_words(near),
        "all": all,
        "samples": None if samples is None else os.fspath(samples),
        "length_error": None if length_error is None else _command.number(length_error),
    }
    return _with_table("pose", read, output, options, table=samples is not None)


def workspace(
    study: StudyLike, *, surface: bool = False, slice: Sequence[str] | None = None, output: str | os.PathLike[str] | None = None, set: Settings | None = None
) -> Result:
    """How far each axis reaches, and the largest box of poses in which all limits are kept.

    Parameters
    ----------
    surface
        add columns: the poses at which lines from home leave the workspace
    slice
        two components, such as ``("surge", "heave")``: these columns for the outline in their plane
    output
        keeps this table in a file
    set
        as in `forces`
    """
    read = as_study(study, set)
    table = surface or slice is not None or output is not None
    return _with_table("workspace", read, output, {"slice": slice and ",".join(slice)}, table=table)


def design(study: StudyLike, *, set: Settings | None = None) -> Result:
    """Values of the keys under `design.vary` so that the required box of poses is certified and the aim is least.

    Returns a `Result` whose ``study`` is the study with the values found.
    """
    read = as_study(study, set)
    with tempfile.TemporaryDirectory(prefix="gough-") as folder:
        path = os.path.join(folder, "found.yaml")
        status, summary, remarks = _command.run("design", [read], {"output": path})
        found = read
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                found = Study.from_text(file.read(), name=read.name)
    return Result("design", found, None, summary, status, remarks)


def report(studies: StudyLike | Sequence[StudyLike], *, set: Settings | None = None) -> Page:
    """The page of one study or of several that are compared: the machine in 3D, curves, numbers and a live simulation."""
    several = [studies] if isinstance(studies, (str, os.PathLike, Mapping, Study)) else list(studies)
    read = [as_study(study, set) for study in several]
    with tempfile.TemporaryDirectory(prefix="gough-") as folder:
        path = os.path.join(folder, "page.html")
        for number, study in enumerate(read):
            if study.path is None and len(read) > 1:  # standard input is one study only
                place = os.path.join(folder, f"{number}.yaml")
                with open(place, "w", encoding="utf-8") as file:
                    file.write(study.text)
                read[number] = Study(place, study.settings)
        status, _, remarks = _command.run("report", read, {"output": path}, as_json=False)
        with open(path, encoding="utf-8") as file:
            return Page(file.read(), status, remarks)


def example(name: str) -> Study:
    """A study of the examples that come with gough, such as ``"paper-heave"``; `gough example` in a shell lists them."""
    _, text, _ = _command.run("example", [name], {}, as_json=False)
    return Study.from_text(text.decode(), name=f"{name}.yaml")
