"""The same machine in SI, in millimetres, in micrometres, in inches and pounds, in feet and milliseconds, and without dimensions:
forces, runs, stability and sweeps are the same physics to 1e-13 (without dimensions 3e-13), and every number that is printed has the right unit."""
import csv
import json
import math
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from units import ALL, study  # noqa: E402

GOUGH = os.environ["GOUGH"]
failures = []


def fail(words):
    failures.append(words)
    print(words)


def gough(*arguments, allowed=(0,)):
    done = subprocess.run([GOUGH, *arguments], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode not in allowed:
        fail(f"{' '.join(arguments)}: exit status {done.returncode}: {done.stderr[:400]}")
    return done


def kind_of(column):
    """What a column of a table measures."""
    for pattern, kind in [(r"t|end_time", "time"), (r"[xyz]|l\d|e[xyz]|position_deviation|initial\.heave", "length"),
                          (r"(e|)(roll|pitch|yaw)|angle_deviation", "angle"), (r"v[xyz]|dl\d|speed", "speed"),
                          (r"w[xyz]", "angular_speed"), (r"a[xyz]", "acceleration"), (r"al[xyz]", "angular_acceleration"),
                          (r"f\d|force", "force"), (r"p\d|power(_least|_greatest)?", "power"), (r"r[xyz][xyz]", "moment"),
                          (r"energy", "energy"), (r"load\.mass", "mass"), (r"control\.damping", "damping")]:
        if re.fullmatch(pattern, column):
            return kind
    return "1"


def near(what, values, wanted, share=1e-13, largest=None):
    """To a share of the largest number."""
    largest = largest or max((abs(w) for w in wanted), default=0)
    if len(values) != len(wanted):
        return fail(f"{what}: {len(values)} numbers, not {len(wanted)}")
    for value, want in zip(values, wanted):
        if not abs(value - want) <= share * largest:
            return fail(f"{what}: {value!r} instead of {want!r}")
    return None


def columns(name):
    with open(name, encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    return {column: [float(row[k]) for row in rows if row[k] not in ("done",)] for k, column in enumerate(head) if column != "end_cause"}


def same_table(what, name, unit, share=1e-13):
    """To 1e-13 of the largest number of that kind: what is small is known to the rounding of the large. Drift is all rounding."""
    own, si = columns(f"{name}.csv"), columns("si-" + name.split("-", 1)[1] + ".csv")
    if unit.natural and share > 2e-15:
        share = max(share, 3e-13)  # each of the two runs is within 1e-13 of the same run in quadruple precision, see below
    largest = {}
    for column, numbers in si.items():
        kind = kind_of(column)
        largest[kind] = max(largest.get(kind, 0), *map(abs, numbers)) if kind != "1" else 1e3
    for column, numbers in si.items():
        kind = kind_of(column)
        size = unit.size(kind)
        if column != "drift":
            near(f"{what} {column}", own[column], [x / size for x in numbers], share, largest[kind] / size)


def labels(path):
    """Units of the columns of a HDF5 table, as h5dump prints them."""
    text = subprocess.run(["h5dump", "-A", path], capture_output=True, text=True, check=True).stdout
    found = {}
    for name, body in re.findall(r'DATASET "([^"]+)" \{(.*?)\n   \}', text, re.S):
        unit = re.search(r'ATTRIBUTE "units" \{.*?\(0\): "([^"]*)"', body, re.S)
        if unit:
            found[name] = unit[1]
    return found


def check_labels(what, path, unit):
    found = labels(path)
    if len(found) < 20:
        fail(f"{what}: only {len(found)} columns have units")
    for name, label in found.items():
        if label != unit.label(kind_of(name)):
            fail(f"{what}: {name} is in '{label}', not '{unit.label(kind_of(name))}'")


def same_json(what, own, si, unit, kinds):
    """Numbers at paths such as ("legs", 0, "force") with what they measure."""
    for path, kind in kinds:
        a, b = own, si
        for step in path:
            a, b = a[step], b[step]
        flat = lambda x: sum(map(flat, x), []) if isinstance(x, list) else [x]
        near(f"{what} {path}", flat(a), [v / unit.size(kind) for v in flat(b)], 1e-12)


def expected_units(unit):
    if unit.natural:
        return "dimensionless"
    usual = {"length": "m", "force": "N", "mass": "kg", "angle": "deg", "time": "s"}
    return "si" if unit.words == usual else unit.words


LEG = [(("legs", k, key), kind) for k in range(6) for key, kind in
       [("length", "length"), ("speed", "speed"), ("force", "force"), ("rms_force", "force"), ("power", "power"), ("energy", "energy")]]
JSON = {
    "check": [(("home_length",), "length"), (("stroke",), "length"), (("determinant",), "volume"), (("principal_moments",), "inertia"),
              (("leg_mass",), "mass"), (("leg_mass_on_top",), "mass"), (("base_radius",), "length"), (("time_unit",), "time"),
              (("groups", "stiffness"), "1"), (("program", "surge"), "length"), (("program", "roll"), "angle"),
              (("simulation", "duration"), "time"), (("simulation", "output_step"), "time")],
    "forces": LEG + [(("end", "time"), "time"), (("limits", 0, "limit"), "length"), (("limits", -1, "worst"), "force")],
    "simulate": LEG + [(("deviation", "position"), "length"), (("deviation", "angle"), "angle"), (("end", "time"), "time")],
    "stability": [(("eigenvalues",), "rate"), (("thresholds", 0, "stiffness"), "stiffness"), (("growth_rate",), "rate"),
                  (("trace",), "stiffness")],
}


def check_text(what, text, unit):
    """No number is followed by a unit of another study, and the units are named."""
    if unit.natural:
        return
    words = set(unit.words.values())
    foreign = {"mm", "um", "in", "ft", "lbf", "kN", "lb", "mrad", "arcsec", "ms", "m", "N", "kg", "s"} - words - {"in", "t"}
    for number, word in re.findall(r"(-?\d[\d.e+-]*) ([a-zA-Z]+)\b", text):
        if word in foreign:
            fail(f"{what}: '{number} {word}' is not in the study's units")
    for heading in re.findall(r"\[([^\]]+)\]", text):
        for part in re.findall(r"[a-zA-Z]+", heading):
            if part in foreign and heading not in ("W", "J"):
                fail(f"{what}: a heading in [{heading}]")


def write_record(path, unit):
    """A second of motion as rows every 1/16 s, in the units of the study."""
    axes = {"surge": ("length", 0.05, 1.1), "heave": ("length", 0.1, 1.0), "roll": ("angle", 3.0, 1.1), "yaw": ("angle", 5.0, 0.9)}
    with open(path, "w", encoding="utf-8") as stream:
        stream.write("t," + ",".join(axes) + "\n")
        for k in range(17):
            t = k / 16
            numbers = [unit.put("time", t)] + [unit.put(kind, a * math.sin(w * t)) for kind, a, w in axes.values()]
            stream.write(",".join(map(repr, numbers)) + "\n")


def check_record(name, unit):
    """Recorded motion: rows and results are in the study's units."""
    write_record(f"{name}-rows.csv", unit)
    with open(f"{name}-record.yaml", "w", encoding="utf-8") as stream:
        stream.write(study(unit, motion={"samples": f"{name}-rows.csv", "about": unit.put("length", [0.02, 0.01, 0.3])}))
    check_text(f"{name} check of a record", gough("check", f"{name}-record.yaml").stdout, unit)
    for verb in ("forces", "simulate"):
        base = f"{name}-record_{verb}"
        text = gough(verb, f"{name}-record.yaml", "-o", f"{base}.csv", "-o", f"{base}.h5")
        check_text(f"{name} {verb} of a record", text.stdout + text.stderr, unit)
        check_labels(f"{name} {verb} of a record", f"{base}.h5", unit)
        # second derivatives of a spline: the rounding of a row is divided by the square of 1/16 s
        same_table(f"{name} {verb} of a record", base, unit, 1e-12)
    moved = columns(f"{name}-record_forces.csv")
    near(f"{name}: heave of the record", [moved["z"][-1]], [unit.put("length", 2 + 0.1 * math.sin(1) + HIGHER)], 1e-6)


# what the top is higher than its heave says, as it turns about a point 0.3 m over its origin: 0.3 (1 - cos roll) and what follows
# from the other offsets; found from R = Rz Ry Rx of roll and yaw at t = 1
def higher():
    roll = math.radians(3 * math.sin(1.1))
    about = (0.02, 0.01, 0.3)
    return about[2] - (math.sin(roll) * about[1] + math.cos(roll) * about[2])


HIGHER = higher()


def check_merge(name, unit):
    """Shards merged are the sweep, bit for bit, with the same units and the same summary."""
    for k in (1, 2, 3):
        gough("sweep", f"{name}.yaml", "--shard", f"{k}/3", "-o", f"{name}-{k}.shard", "-q")
    shards = [f"{name}-{k}.shard" for k in (1, 2, 3)]
    text = gough("merge", *shards, "-o", f"{name}-merge.csv", "-o", f"{name}-merge.h5")
    check_text(f"{name} merge", text.stdout + text.stderr, unit)
    check_labels(f"{name} merge", f"{name}-merge.h5", unit)
    if columns(f"{name}-merge.csv") != columns(f"{name}-sweep.csv"):
        fail(f"{name}: merged shards differ from the sweep")
    merged, whole = (json.loads(gough(*line, "--json").stdout) for line in
                     (["merge", *shards, "-o", f"{name}-again.csv"], ["sweep", f"{name}.yaml", "-o", f"{name}-once.csv"]))
    if merged["units"] != expected_units(unit):
        fail(f"{name} merge: units {merged['units']}")
    for key in ("position_deviation", "angle_deviation", "force", "speed", "power"):
        if merged[key] != whole[key]:
            fail(f"{name} merge: {key} is {merged[key]}, not {whole[key]}")


def main():
    for name, unit in ALL.items():
        with open(f"{name}.yaml", "w", encoding="utf-8") as stream:
            stream.write(study(unit))
    si = {}
    for name, unit in ALL.items():
        text = gough("check", f"{name}.yaml")
        check_text(f"{name} check", text.stdout + text.stderr, unit)
        if not unit.natural and name != "si" and f"lengths in {unit.words['length']}, forces in {unit.words['force']}" not in text.stdout:
            fail(f"{name} check does not name the units")
        for verb in ("forces", "simulate"):
            text = gough(verb, f"{name}.yaml", "-o", f"{name}-{verb}.csv", "-o", f"{name}-{verb}.h5", "--reactions")
            check_text(f"{name} {verb}", text.stdout + text.stderr, unit)
            check_labels(f"{name} {verb}", f"{name}-{verb}.h5", unit)
            same_table(f"{name} {verb}", f"{name}-{verb}", unit)
        if name in ("si", "natural"):  # in 33 digits the rounding of the study and of the table is left
            gough("simulate", f"{name}.yaml", "-o", f"{name}-quad.csv", "-q", "--precision", "quad")
            same_table(f"{name} quadruple precision", f"{name}-quad", unit, 1e-15)
        gough("sweep", f"{name}.yaml", "-o", f"{name}-sweep.csv", "-q")
        gough("sweep", f"{name}.yaml", "-o", f"{name}-sweep.h5", "-q")
        check_labels(f"{name} sweep", f"{name}-sweep.h5", unit)
        same_table(f"{name} sweep", f"{name}-sweep", unit)
        check_merge(name, unit)
        check_record(name, unit)
        check_text(f"{name} stability", gough("stability", f"{name}.yaml", "--pose", "heave=0").stdout, unit)
        for verb, kinds in JSON.items():
            more = ("--pose", "heave=0") if verb == "stability" else ()
            own = json.loads(gough(verb, f"{name}.yaml", "--json", "-q", *more).stdout) if verb != "check" else json.loads(
                gough(verb, f"{name}.yaml", "--json").stdout)
            si.setdefault(verb, own)
            if own["units"] != expected_units(unit):
                fail(f"{name} {verb}: units {own['units']}")
            same_json(f"{name} {verb}", own, si[verb], unit, kinds)
    print("", end="")
    sys.exit(1 if failures else 0)


main()
