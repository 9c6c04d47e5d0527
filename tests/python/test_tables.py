"""Columns and summaries against the command: the same bits."""
import csv
import json
import math

import gough
import numpy as np
import pytest

QUICK = ["paper-heave", "flight-simulator-legs", "sampled-heave"]  # all of them: campaign/test_all_examples.py


def columns_of(path):
    """A table in CSV, read by other means than the library's."""
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return header, np.array([[float(number) for number in row] for row in rows]).T


def same_bits(one, other):
    return np.array_equal(np.asarray(one).view(np.uint64), np.asarray(other).view(np.uint64))


@pytest.mark.parametrize("verb", ["forces", "simulate"])
@pytest.mark.parametrize("name", QUICK)
def test_same_bits_as_the_command(verb, name, examples, command, tmp_path):
    study, path = examples / f"{name}.yaml", tmp_path / "table.csv"
    status, text = command(verb, study, "--json", "-o", path)
    result = getattr(gough, verb)(study)
    header, numbers = columns_of(path)
    assert status in (0, 1) and result.status == status
    assert list(result) == header
    for column, expected in zip(header, numbers):
        assert same_bits(result[column], expected), column
    assert result.summary == json.loads(text)
    end = json.loads(text)["end"]
    assert result.end.cause == end["status"] and result.end.leg == end["leg"]
    assert result.end.time == pytest.approx(end["time"], rel=1e-15)
    result.save(tmp_path / "saved.csv")
    assert (tmp_path / "saved.csv").read_bytes() == path.read_bytes()


def test_options_are_those_of_the_command(examples, command, tmp_path):
    study, path = examples / "flight-simulator-legs.yaml", tmp_path / "table.csv"
    command("forces", study, "--joints", "--reactions", "--dimensionless", "-o", path)
    result = gough.forces(study, joints=True, reactions=True, dimensionless=True)
    header, numbers = columns_of(path)
    assert list(result) == header and result.units["f1"] == "1"
    assert all(same_bits(result[column], expected) for column, expected in zip(header, numbers))


def test_columns_are_read_only_and_not_copied(machine):
    result = gough.forces(machine)
    force = result["f1"]
    assert force.dtype == np.float64 and not force.flags.writeable and not force.flags.owndata
    del result
    assert math.isfinite(force.sum())  # the numbers live as long as the array


def test_units_and_names(machine):
    machine["units"] = {"length": "mm"}
    machine["platform"] = {"base": {"radius": 1500, "half_angle": 8}, "top": {"radius": 1100, "half_angle": 8}, "height": 2000}
    machine["load"] = {"mass": 1050, "inertia": [410e6, 520e6, 460e6]}
    machine["motion"] = {"heave": "100*sin(2*t)", "roll": "5*sin(3*t)"}
    result = gough.forces(machine)
    assert result.units["l1"] == "mm" and result.units["f1"] == "N" and result.long_names["t"] == "time"
    assert 1000 < result["l1"][0] < 3000
    with pytest.raises(KeyError, match="no column"):
        result["g1"]


def test_a_run_that_ends_early_keeps_its_rows(machine):
    machine["platform"]["legs"] = {"length": [1.9, 2.5]}
    machine["disturbance"] = {"leg_force": 400}
    result = gough.simulate(machine)
    assert result.status == 1 and result.end.cause.startswith("leg_") and 0 < len(result["t"]) < 21
    assert f"t = {result.end.time:.9g} s" in result.end.message
    assert result.end.limit in (1.9, 2.5)
    assert result.summary["end"]["message"] == result.end.message


def test_tables_of_other_libraries(machine):
    result = gough.forces(machine)
    pandas = pytest.importorskip("pandas")
    frame = result.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame.index.name == "t"
    assert np.array_equal(frame["f3"].to_numpy(), result["f3"]) and frame.attrs["units"]["f3"] == "N"
    pytest.importorskip("xarray")
    data = result.to_xarray()
    assert data["f3"].attrs["units"] == "N" and data["t"].attrs["units"] == "s"
