"""Studies from files, mappings and texts, and errors with their places."""
import pathlib
import subprocess
import sys
import typing

import gough
import numpy as np
import pytest


def test_mapping_is_the_file_that_it_describes(machine, tmp_path):
    study = gough.Study(machine)
    path = tmp_path / "machine.yaml"
    path.write_text(study.text)
    for other in (gough.Study(path), gough.Study.from_text(study.text), gough.Study(str(path))):
        assert other.title == "A machine"
        assert np.array_equal(gough.forces(other)["f1"], gough.forces(machine)["f1"])


def test_mapping_takes_numpy(machine):
    machine["load"] = {"mass": np.float64(1050), "inertia": np.array([410.0, 520.0, 460.0])}
    assert gough.forces(machine)["f1"][0] == gough.forces(gough.Study(machine))["f1"][0]


def test_settings_override_keys(machine):
    heavy = gough.forces(machine, set={"load.mass": 2100})["f1"]
    machine["load"]["mass"] = 2100
    assert np.array_equal(heavy, gough.forces(machine)["f1"])
    assert np.array_equal(heavy, gough.forces(gough.Study(machine).with_settings(load__mass=2100))["f1"])


@pytest.mark.parametrize(
    "change, key, line, column",
    [({"load": {"mass": -1, "inertia": [1, 1, 1]}}, "load.mass", 11, 9), ({"motoin": 1}, "motoin", 19, 1)],
)
def test_errors_have_their_place(machine, change, key, line, column):
    with pytest.raises(gough.StudyError) as caught:
        gough.Study({**machine, **change})
    error = caught.value
    assert (error.key, error.line, error.column, error.file) == (key, line, column, "study")
    assert f"`{key}`" in error.sentence
    text = str(error)
    assert f"study:{line}:{column}: error: " in text


def test_all_errors_come_together(machine):
    machine["load"]["mass"] = -1
    machine["platform"]["height"] = "high"
    with pytest.raises(ValueError) as caught:
        gough.Study(machine)
    assert {error.key for error in caught.value.errors} == {"load.mass", "platform.height"}


def test_a_setting_that_is_wrong_is_named(machine):
    with pytest.raises(gough.StudyError) as caught:
        gough.forces(machine, set={"load.mass": "heavy"})
    assert caught.value.key == "load.mass" and caught.value.line is None


def test_a_file_that_is_missing():
    with pytest.raises(gough.FileError) as caught:
        gough.forces("there-is-no-such.yaml")
    assert caught.value.file == "there-is-no-such.yaml"
    with pytest.raises(OSError):
        gough.forces(pathlib.Path("neither-this.yaml"))


def test_a_mapping_with_something_else():
    with pytest.raises(TypeError, match="not object"):
        gough.Study({"load": {"mass": object()}})
    with pytest.raises(TypeError, match="keys of a study are texts"):
        gough.Study({1: 2})


def test_numpy_is_imported_when_it_is_used():
    code = "import sys, gough; assert 'numpy' not in sys.modules; gough.rotation([0, 0, 0]); assert 'numpy' in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_type_hints_can_be_read():
    for function in (gough.rotation, gough.Machine.lengths, gough.Machine.step, gough.Plants.move, gough.VectorEnv.step, gough.forces):
        assert "return" in typing.get_type_hints(function)
    assert typing.get_type_hints(gough.Machine.lengths)["return"] is np.ndarray
