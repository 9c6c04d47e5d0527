"""Dynamics and control of Stewart-Gough platforms: leg forces, motion, stability, sweeps, poses and workspaces of hexapods.

>>> import gough
>>> gough.forces("heave.yaml")["f1"]

Functions of the module are the verbs of the command `gough`; `Machine` computes many poses at once.
"""
from ._errors import FileError, GoughError, Message, NumericalError, StudyError
from ._gough import version as __version__
from ._machine import Accelerations, Conditioning, Followed, JointForces, Machine, Moved, angles, rotation
from ._results import End, Page, Result
from ._study import Study
from ._vector import ENDED, Box, Plants, VectorEnv
from ._verbs import check, design, example, forces, merge, pose, report, simulate, stability, sweep, tune, workspace

__all__ = [
    "Accelerations",
    "Box",
    "Conditioning",
    "ENDED",
    "End",
    "FileError",
    "Followed",
    "GoughError",
    "JointForces",
    "Machine",
    "Message",
    "Moved",
    "NumericalError",
    "Page",
    "Plants",
    "Result",
    "Study",
    "StudyError",
    "VectorEnv",
    "angles",
    "check",
    "design",
    "example",
    "forces",
    "merge",
    "pose",
    "report",
    "rotation",
    "simulate",
    "stability",
    "sweep",
    "tune",
    "workspace",
]
