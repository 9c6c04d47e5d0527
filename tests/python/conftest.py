"""What the tests of the package share."""
import os
import pathlib
import subprocess

import pytest

SOURCE = pathlib.Path(os.environ["SOURCE"])
EXAMPLES = SOURCE / "examples"
COMMAND = os.environ["GOUGH"]


@pytest.fixture
def examples() -> pathlib.Path:
    """The folder of the examples."""
    return EXAMPLES


@pytest.fixture
def command():
    """Runs the command of the build: its exit status and standard output."""

    def run(*arguments, text: str = "") -> tuple[int, str]:
        done = subprocess.run([COMMAND, *map(str, arguments)], input=text, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    return run


@pytest.fixture
def machine() -> dict:
    """A machine as a mapping, with a program."""
    return {
        "title": "A machine",
        "platform": {"base": {"radius": 1.5, "half_angle": 8}, "top": {"radius": 1.1, "half_angle": 8}, "height": 2},
        "load": {"mass": 1050, "inertia": [410, 520, 460]},
        "motion": {"heave": "0.1*sin(2*t)", "roll": "5*sin(3*t)"},
        "simulation": {"duration": 1, "output_step": 0.05},
    }
