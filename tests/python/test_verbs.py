"""The verbs that run the command: the same numbers, and errors as exceptions."""
import json

import gough
import numpy as np
import pytest
from comparison import columns_of, same


@pytest.mark.parametrize("name", ["own-machine", "flight-simulator-legs"])
def test_check(name, examples, command):
    study = examples / f"{name}.yaml"
    same(gough.check(study), *command("check", study, "--json"))
    same(gough.check(study, pose={"heave": 0.01}), *command("check", study, "--json", "--pose", "heave=0.01"))


def test_sweep_shards_and_merge(examples, command, tmp_path):
    study, path = examples / "gain-sweep.yaml", tmp_path / "sweep.csv"
    few = {"simulation.duration": 1}
    status, text = command("sweep", study, "--json", "--set=simulation.duration=1", "-o", path)
    whole = gough.sweep(study, set=few)
    assert whole.status == status and list(whole)[0] == "run"
    clock = {"output", "time", "rate"}  # how long it took, and where the table is
    assert {k: v for k, v in whole.summary.items() if k not in clock} == {k: v for k, v in json.loads(text).items() if k not in clock}
    header, columns = columns_of(path)
    words = header.index("end_cause")
    for number, name in enumerate(header):
        if number != words:
            assert np.array_equal(whole[name], np.array([float(x) for x in columns[number]])), name
    shards = [tmp_path / f"{i}.shard" for i in (1, 2, 3)]
    for i, shard in enumerate(shards, 1):
        gough.sweep(study, shard=(i, 3), output=shard, set=few)
    joined = gough.merge(shards[::-1], output=tmp_path / "joined.csv")
    assert (tmp_path / "joined.csv").read_bytes() == path.read_bytes()
    assert all(np.array_equal(joined[name], whole[name]) for name in whole)
    with pytest.raises(gough.StudyError, match="a shard needs"):
        gough.sweep(study, shard=(1, 3))
    with pytest.raises(gough.StudyError):
        gough.merge(shards[:2])


def test_stability(examples, command):
    study = examples / "paper-feedback.yaml"
    same(gough.stability(study, matrix=True), *command("stability", study, "--json", "--matrix"))


def test_tune_by_poles(examples, command):
    study = examples / "paper-perturbed.yaml"
    same(gough.tune(study, poles=(1, 0.7)), *command("tune", study, "--json", "--poles=1,0.7"))


def test_pose(examples, command, machine, tmp_path):
    study = examples / "own-machine.yaml"
    lengths = gough.Machine(study).lengths([0.01, 0, 0.29])
    words = ",".join(map(repr, lengths.tolist()))
    same(gough.pose(study, lengths=lengths), *command("pose", study, "--json", f"--lengths={words}"))
    every = gough.pose(study, lengths=lengths, all=True)
    assert any(np.allclose(p["position"], [0.01, 0, 0.29], atol=1e-10) for p in every.summary["poses"])
    lost = gough.pose(study, lengths=0.1 * lengths)
    assert lost.status == 1 and lost.summary["message"] and lost.remarks
    table = gough.forces(machine)
    table.save(tmp_path / "lengths.csv")
    record = gough.pose(machine, samples=tmp_path / "lengths.csv", length_error=1e-9)
    assert np.abs(record["heave"] + 2 - table["z"]).max() < 1e-9


def test_report_is_the_page_of_the_command(examples, command, machine, tmp_path):
    study, path = examples / "paper-heave.yaml", tmp_path / "page.html"
    status, _ = command("report", study, "-o", path)
    if status not in (0, 1):
        pytest.skip("built without the page")
    page = gough.report(study)
    assert page.html == path.read_text(encoding="utf-8") and page.status == status
    page.save(tmp_path / "saved.html")
    assert (tmp_path / "saved.html").read_bytes() == path.read_bytes()
    both = gough.report([study, machine])
    assert "A machine" in both.html and page._repr_html_().startswith("<iframe srcdoc=")
    assert gough.forces(study)._repr_html_().startswith("<iframe srcdoc=")
    assert "<pre>" in gough.check(study)._repr_html_()


def test_errors_of_the_command(examples, machine):
    with pytest.raises(gough.StudyError, match="six lengths") as caught:
        gough.pose(machine, lengths=[1, 2])
    assert caught.value.line is None and caught.value.sentence.startswith("--lengths takes six lengths") and "Try" not in str(caught.value)
    with pytest.raises(gough.StudyError) as caught:
        gough.sweep(machine)
    assert "sweep" in str(caught.value)
    with pytest.raises(gough.FileError):
        gough.merge([examples / "there-is-no-such.shard"])


def test_a_law_in_python_is_the_law_of_the_study(machine):
    machine["control"] = {"feedforward": "program", "stiffness": 4e5, "damping": 1.5e4, "sampling": {"period": 0.01}}
    machine["disturbance"] = {"leg_force": 20}
    own = gough.simulate(machine)
    samples = []

    def law(sample):
        samples.append(sample["number"])
        return [
            f + 4e5 * (w - l) + 1.5e4 * (dw - dl)
            for f, w, l, dw, dl in zip(*(sample[n] for n in ("program_force", "program_length", "length", "program_rate", "rate")))
        ]

    python = gough.simulate(machine, law=law)
    assert samples == sorted(samples) and len(samples) >= 100
    assert np.abs(python["z"] - own["z"]).max() < 1e-9 and np.ptp(own["ez"]) > 1e-6
    assert np.array_equal(gough.simulate(machine, law=lambda sample: None)["z"], own["z"])
    with pytest.raises(AttributeError, match="no summary"):
        python.summary
    with pytest.raises(ZeroDivisionError):
        gough.simulate(machine, law=lambda sample: 1 / 0)
    with pytest.raises(ValueError, match="six forces"):
        gough.simulate(machine, law=lambda sample: [1, 2])
    with pytest.raises(TypeError):
        gough.simulate(machine, law=lambda sample: ["a"] * 6)


@pytest.mark.parametrize("kind", ["overview", "motion", "lengths", "forces", "rates", "power"])
def test_figures(kind, machine):
    pytest.importorskip("matplotlib")
    result = gough.forces(machine)
    figure = result.plot(kind)
    assert all(axes.get_ylabel().endswith("]") for axes in figure.axes if axes.get_visible())
    if kind == "forces":
        lines = figure.axes[0].get_lines()
        assert [line.get_label() for line in lines] == [f"leg {leg}" for leg in range(1, 7)]
        assert np.array_equal(lines[2].get_ydata(), result["f3"]) and lines[0].get_color() == "#0072b2"
        assert figure.axes[0].get_ylabel() == "leg force [N]" and figure.axes[0].get_xlabel() == "t [s]"


def test_figures_of_columns_and_wrong_kinds(machine):
    pytest.importorskip("matplotlib")
    result = gough.simulate(machine)
    assert len(result.plot(columns=["f1", "l1"]).axes) == 2
    assert len(result.plot("deviation").axes) == 2
    with pytest.raises(ValueError, match="kinds are"):
        result.plot("nonsense")
    with pytest.raises(ValueError, match="no columns"):
        gough.check(machine).plot()
