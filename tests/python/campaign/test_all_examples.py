"""Every verb on every example, against the command: the same status, JSON and bits."""
import json

import gough
import numpy as np
import pytest
from comparison import columns_of, same
from conftest import EXAMPLES

NAMES = sorted(path.stem for path in EXAMPLES.glob("*.yaml"))


@pytest.fixture(autouse=True)
def record_of_the_ship(command, tmp_path):
    """The recorded motion that some examples read is made by a program of the examples."""
    import subprocess

    made = tmp_path / "examples"
    made.mkdir()
    for path in EXAMPLES.glob("*.yaml"):
        (made / path.name).write_bytes(path.read_bytes())
    record = subprocess.run(["awk", "-f", EXAMPLES / "ship-deck.awk"], capture_output=True, check=True).stdout
    (made / "ship-deck.csv").write_bytes(record)
    return made


@pytest.mark.parametrize("verb", ["check", "stability", "workspace"])
@pytest.mark.parametrize("name", NAMES)
def test_summaries(verb, name, command, record_of_the_ship):
    study = record_of_the_ship / f"{name}.yaml"
    status, text = command(verb, study, "--json")
    if not text:
        with pytest.raises(gough.GoughError):
            getattr(gough, verb)(study)
    else:
        same(getattr(gough, verb)(study), status, text)


@pytest.mark.parametrize("verb", ["forces", "simulate"])
@pytest.mark.parametrize("name", NAMES)
def test_tables(verb, name, command, record_of_the_ship, tmp_path):
    study, path = record_of_the_ship / f"{name}.yaml", tmp_path / "table.csv"
    status, text = command(verb, study, "--json", "-o", path, "-o", tmp_path / "table.h5")
    if status > 1:
        with pytest.raises(gough.GoughError):
            getattr(gough, verb)(study)
        return
    result = getattr(gough, verb)(study)
    same(result, status, text, path)
    result.save(tmp_path / "saved.csv")
    result.save(tmp_path / "saved.h5")
    assert (tmp_path / "saved.csv").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("name", NAMES)
def test_home_pose_and_page(name, command, record_of_the_ship, tmp_path):
    study = record_of_the_ship / f"{name}.yaml"
    length = json.loads(command("check", study, "--json")[1])["home_length"]
    words = ",".join(map(repr, length))
    same(gough.pose(study, lengths=length), *command("pose", study, "--json", f"--lengths={words}"))
    page = tmp_path / "page.html"
    status, _ = command("report", study, "-o", page)
    if status in (0, 1):
        made = gough.report(study)
        assert made.status == status and made.html == page.read_text(encoding="utf-8")


def test_sweeps(command, record_of_the_ship, tmp_path):
    for name in NAMES:
        study, path = record_of_the_ship / f"{name}.yaml", tmp_path / f"{name}.csv"
        if "\nsweep:" not in study.read_text(encoding="utf-8"):
            continue
        status, _ = command("sweep", study, "--json", "-o", path)
        result = gough.sweep(study)
        header, columns = columns_of(path)
        assert result.status == status and list(result) == header
        for column, texts in zip(header, columns):
            if column != "end_cause":
                assert np.array_equal(result[column], np.array([float(text or "nan") for text in texts]), equal_nan=True), column


def test_tune(examples, command, tmp_path):
    study, path = examples / "paper-perturbed.yaml", tmp_path / "curve.csv"
    options = ["--deviation=0.01", "--feedforward=program", "--stiffness=20:200", "--set=simulation.duration=2"]
    expected = command("tune", study, "--json", *options, "-o", path)
    found = gough.tune(study, deviation=0.01, feedforward="program", stiffness=(20, 200), set={"simulation.duration": 2})
    same(found, *expected, path)
    same(gough.tune(study, poles=(1, 0.7)), *command("tune", study, "--json", "--poles=1,0.7"))


def test_workspace_and_design(examples, command, tmp_path):
    study, path = examples / "motion-base.yaml", tmp_path / "outline.csv"
    expected = command("workspace", study, "--json", "--slice=surge,heave", "-o", path)
    same(gough.workspace(study, slice=("surge", "heave")), *expected, path)
    quick = {"design.evaluations": 20}
    found = gough.design(examples / "flight-design.yaml", set=quick)
    status, text = command("design", examples / "flight-design.yaml", "--json", "--set=design.evaluations=20")
    assert found.status == status
    assert found.summary["best"] == json.loads(text)["best"] if "best" in found.summary else found.summary


def test_stability_and_its_map(examples, command, tmp_path):
    study, path = examples / "paper-feedback.yaml", tmp_path / "map.csv"
    same(gough.stability(study, matrix=True), *command("stability", study, "--json", "--matrix"))
    expected = command("stability", study, "--json", "--sweep-stiffness=10:40:4:log", "-o", path)
    same(gough.stability(study, sweep_stiffness=(10, 40, 4, "log")), *expected, path)
