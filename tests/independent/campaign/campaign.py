#!/usr/bin/env python3
"""Random studies through every verb of the command, each number that it prints against one independent computation.

    campaign.py --gough build/gough --studies 50 --seed 1 [--first 0] [--jobs 1] [--keep FOLDER]

Study number k depends on the seed and k alone. What differs is told with the study, the verb and the number's name; the exit
status is 1 then. Standard library only; what is not compared is listed at the end with its reason.
"""
import argparse
import collections
import concurrent.futures
import csv
import io
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import facts
import limits
import mechanics
import printed
import studies
import sweeps
import verbs


class Case:
    """One study: its file, its meaning, and what was compared."""

    def __init__(self, gough, seed, number, folder):
        self.gough, self.number, self.folder = gough, number, folder
        self.maker = studies.Maker(seed, number)
        self.tree = self.maker.make()
        if number % 5 == 1:
            self.tree["sweep"] = sweeps.random_sweep(self.maker, self.tree)
        self.meaning = studies.Meaning(self.tree)
        self.path = os.path.join(folder, f"study-{number}.yaml")
        with open(self.path, "w", encoding="utf-8") as stream:
            stream.write(studies.written(self.tree))
        self.compared, self.failures, self.skipped, self.worst = collections.Counter(), [], {}, collections.defaultdict(float)

    def fail(self, what):
        self.failures.append(f"study {self.number}: {what}")

    def run(self, *arguments, allowed=(0,)):
        done = subprocess.run([self.gough, *arguments], capture_output=True, text=True, cwd=self.folder)
        if done.returncode not in allowed:
            self.fail(f"gough {' '.join(arguments)} ends with {done.returncode}: {done.stderr.strip()}")
            raise StopIteration
        return done

    def data(self, verb, *arguments, allowed=(0,)):
        """What a verb prints as JSON, without the number of its format."""
        data = json.loads(self.run(verb, *arguments, allowed=allowed).stdout)
        self.same(f"{verb} json format", data.pop("format", None), 1)
        return data

    # ---- comparing ----

    def near(self, where, got, value, slack, half=0.0):
        """One number: within its slack and half of its last printed digit. What is not a number differs."""
        self.compared[where.split()[0]] += 1
        gap = abs(got - value) if math.isfinite(got) else math.inf
        if slack > 0 and math.isfinite(gap):
            self.worst[re.sub(r"[0-9\[\]]+", "", where)] = max(self.worst[re.sub(r"[0-9\[\]]+", "", where)], (gap - half) / slack)
        if not gap <= slack + half:
            self.fail(f"{where}: printed {got!r}, computed {value!r} (± {slack:.1g}, half a digit {half:.1g})")

    def same(self, where, got, wanted):
        self.compared[where.split()[0]] += 1
        if got != wanted:
            self.fail(f"{where}: {got!r}, expected {wanted!r}")

    def text(self, verb, text, known, wanted, units):
        """The numbers of a text by name; returns those that `wanted` does not have."""
        rest = {}
        try:
            found = printed.read(text, known)
        except printed.Unreadable as error:
            self.fail(f"{verb} text: {error}")
            return rest
        for name, number in found:
            q = wanted.get(name)
            if q is None:
                rest.setdefault(name, []).append(number)
            elif not isinstance(number, printed.Printed):
                self.fail(f"{verb} {name}: printed as {number!r}")
            else:
                value, slack = units.of(q)
                self.near(f"{verb} text {name}", number.value, value, slack, number.half)
        return rest

    def deviations(self, run, rest, units):
        """Deviations that are said to be below the accuracy of the run, which is rounded up to a digit; and that others are not."""
        for name, noise in verbs.noise_of(self.meaning, units).items():
            bound = rest.pop(f"{name}_below", None)
            value, slack = units.of(run.facts()[name])
            if bound is None:
                self.same(f"simulate text {name} below its accuracy", value + slack < noise, False)
                continue
            self.same(f"simulate text accuracy of {name}", noise * 0.999999 <= bound[0].value <= 2.000001 * noise, True)
            self.same(f"simulate text {name} below {bound[0]}", value - slack <= noise, True)

    def tree_of(self, verb, got, wanted, units, path=""):
        """JSON against what it should be: the same keys, each number near."""
        if isinstance(wanted, facts.Skip):
            self.skipped[f"{verb} {re.sub('[0-9]+', 'N', path)}"] = wanted.reason
        elif isinstance(wanted, dict):
            if not isinstance(got, dict) or set(got) != set(wanted):
                keys = set(got) if isinstance(got, dict) else got
                self.fail(f"{verb} --json {path}: has the keys {keys}, expected {set(wanted)}")
                return
            for key in wanted:
                self.tree_of(verb, got[key], wanted[key], units, f"{path}.{key}" if path else key)
        elif isinstance(wanted, list):
            if not isinstance(got, list) or len(got) != len(wanted):
                self.fail(f"{verb} --json {path}: {got!r} has not {len(wanted)} elements")
                return
            for k, (a, b) in enumerate(zip(got, wanted)):
                self.tree_of(verb, a, b, units, f"{path}[{k + 1}]")
        elif isinstance(wanted, facts.Q):
            if isinstance(got, bool) or not isinstance(got, (int, float)):
                self.fail(f"{verb} --json {path}: {got!r} is no number")
                return
            value, slack = units.of(wanted)
            self.near(f"{verb} json {path}", got, value, slack + 4e-16 * abs(value))
        else:
            self.compared[verb] += 1
            if not (got in wanted if isinstance(wanted, set) else got == wanted and type(got) is type(wanted)):
                self.fail(f"{verb} --json {path}: {got!r}, expected {wanted!r}")

    # ---- verbs ----

    def check(self):
        """The machine; returns its principal axes once they are known to be some."""
        check = verbs.Check(self.meaning)
        units = facts.Units(self.meaning, False)
        name = os.path.basename(self.path)
        data = self.data("check", name, "--json")
        check.order_of(data["principal_moments"])
        self.tree_of("check", data, check.json(), units)
        axes = data["principal_axes"]
        self.axes_of_inertia("json", axes, data["principal_moments"], [[1e-9] * 3] * 3, check)
        rest = self.text("check", self.run("check", name).stdout, check.lines(name, units), check.facts(), units)
        if rest:
            printed_axes = [[rest[f"axis_{a}{k}"][0].value for k in range(3)] for a in range(3)]
            halves = [[rest[f"axis_{a}{k}"][0].half for k in range(3)] for a in range(3)]
            for a in range(3):
                for k in range(3):
                    self.near("check text axis", printed_axes[a][k], axes[a][k], 1e-15, halves[a][k])
            if rest["weakest"][0] not in check.weakest_allowed():
                self.fail(f"check: the weakest direction is {rest['weakest'][0]}, expected {check.weakest_allowed()}")
        return [tuple(a) for a in axes]

    def axes_of_inertia(self, form, axes, moments, slack, check):
        """Orthonormal, right-handed, and J e = moment e for each."""
        J, size = self.meaning.machine.inertia, max(check.moments)
        for a, (e, moment) in enumerate(zip(axes, moments)):
            image = mechanics.apply(J, e)
            for k in range(3):
                self.near(f"check {form} axis", image[k] / size, moment * e[k] / size, slack[a][k])
            for b in range(3):
                self.near(f"check {form} axis", mechanics.dot(e, axes[b]), float(a == b), slack[a][0])
        self.near(f"check {form} axis", mechanics.dot(mechanics.cross(axes[0], axes[1]), axes[2]), 1.0, slack[0][0])

    def verb(self, run, title, scaled, reactions):
        """forces or simulate: text, JSON and table, in the study's units or dimensionless."""
        units = facts.Units(self.meaning, scaled)
        name = os.path.basename(self.path)
        options = ["--dimensionless"] if scaled else []
        status = (0,) if run.end["status"] == "done" else (1,)
        table = ["-o", "table.csv"] + (["--reactions", "--joints"] if reactions else [])
        data = self.data(run.verb, name, "--json", *options, allowed=status)
        self.tree_of(run.verb, data, run.json() | {"units": units.name}, units)
        done = self.run(run.verb, name, *options, *table, allowed=status)
        lines, wanted = run.limit_lines(units)
        known = verbs.summary_lines(self.meaning, units, run.simulated, title, done.stdout) + run.end_lines(units) + lines
        known += [printed.Line("table table.csv", units.name)] + verbs.rows_lines(units)
        rest = self.text(run.verb, done.stdout, known, run.facts() | wanted, units)
        self.sentence(run, data["end"]["message"], done.stderr, units)
        if rest:
            self.condition_time(run, rest.pop("condition_time")[0], units)
            if run.simulated:
                self.near("simulate text drift", rest.pop("drift")[0].value, 0.0, 1e-6)
                self.deviations(run, rest, units)
            run.compare_rows(self, rest.pop("records", []), units)
            for name in list(rest):
                if name in run.nearest:
                    self.same(f"{run.verb} text {name}", int(rest.pop(name)[0].value) in run.nearest[name], True)
            for name in rest:
                self.fail(f"{run.verb} text: nothing is known of {name}")
        with open(os.path.join(self.folder, "table.csv"), encoding="utf-8") as stream:
            self.table(run, stream.read(), units, reactions)

    def sentence(self, run, message, said, units):
        """The end as a sentence, in JSON and on standard error, where only an end is an error."""
        template = limits.sentence(run.end, units)
        errors = [line for line in said.splitlines() if " error: " in line]
        self.same(f"{run.verb} errors", len(errors), 1 if template else 0)
        if not template:
            self.same(f"{run.verb} json end.message", message, "")
            return
        for text, start in [(message, "")] + [(line, f"gough {run.verb}: error: {os.path.basename(self.path)}: ") for line in errors]:
            self.text(run.verb, text, [printed.Line(start + template, units.name)], limits.sentence_facts(run.end), units)

    def condition_time(self, run, number, units):
        """The condition at the time that is printed for it is the largest."""
        size = units.size["time"]
        slope = 0.0
        for shift in (-number.half * size, number.half * size):
            at = min(max(number.value * size + shift, 0.0), run.until)
            slope = max(slope, abs(run.condition_at(at) - run.condition_at(min(max(number.value * size, 0), run.until))))
        self.near(f"{run.verb} text condition_time", run.condition_at(min(number.value * size, run.until)), run.condition,
                  run.condition_slack + slope + 2e-4 * run.condition)
        if not number.value * size <= run.until * (1 + 1e-5):
            self.fail(f"{run.verb}: the condition is worst at t = {number}, after the end")

    def table(self, run, text, units, reactions):
        verb, lines = run.verb, list(csv.reader(io.StringIO(text)))
        wanted = list(run.rows())
        if len(lines) != len(wanted) + 1:
            self.fail(f"{verb} table: {len(lines) - 1} rows, expected {len(wanted)}")
            return
        heads = [name for name in wanted[0] if reactions or name not in facts.REACTIONS + facts.JOINTS] + (["drift"] if run.simulated else [])
        if set(lines[0]) != set(heads):
            self.fail(f"{verb} table: columns {lines[0]}, expected {heads}")
            return
        size = {name: max(abs(row[name][0]) for row in wanted) for name in wanted[0]}
        share = 4 * run.slack
        for k, (line, row) in enumerate(zip(lines[1:], wanted)):
            for name, word in zip(lines[0], line):
                if name == "drift":
                    if not 0 <= float(word) < 1e-6:
                        self.fail(f"{verb} table: drift {word}")
                    continue
                value, dimension = row[name]
                natural = run.scales.size[dimension]
                slack = 1e-15 * k * natural if name == "t" else share * (size[name] + natural) * (row["condition"][0] if name == "condition" else 1)
                value, slack = units.of(facts.Q(value, dimension, slack))
                gap = float(word) - value
                if name in ("roll", "yaw", "pitch"):
                    gap = math.remainder(gap, 360)
                self.near(f"{verb} csv {name}", value + gap, value, slack)

    def sweep(self, sweep, scaled):
        units = facts.Units(self.meaning, scaled)
        name = os.path.basename(self.path)
        options = ["--dimensionless"] if scaled else []
        self.tree_of("sweep", self.data("sweep", name, "--json", *options), sweep.json() | {"units": units.name}, units)
        done = self.run("sweep", name, *options, "-o", "sweep.csv")
        known = sweep.lines(units) + [printed.Line("wrote sweep.csv", units.name)]
        rest = self.text("sweep", done.stdout, known, sweep.facts(), units)
        if rest:
            sweep.compare_rest(self, rest, units)
            for name_ in rest:
                self.fail(f"sweep text: nothing is known of {name_}")
        with open(os.path.join(self.folder, "sweep.csv"), encoding="utf-8") as stream:
            heads, *lines = csv.reader(stream)
        self.same("sweep csv number of rows", len(lines), len(sweep.runs))
        for k, line in enumerate(lines):
            row = sweep.row(k)
            self.same("sweep csv columns", set(heads), set(row))
            for head, word in zip(heads, line):
                wanted = row.get(head)
                if isinstance(wanted, facts.Q):
                    value, slack = units.of(wanted)
                    self.near(f"sweep csv {head}", float(word), value, slack + 4e-16 * abs(value))
                else:
                    self.same(f"sweep csv {head}", word, str(wanted))

    def settings(self, sweep):
        """--run N: what to set for that run, as text and as JSON."""
        name, units = os.path.basename(self.path), facts.Units(self.meaning, False)
        for number in {1 + self.number % len(sweep.runs), len(sweep.runs)}:
            wanted = sweep.set_of(number)
            data = self.data("sweep", name, "--run", str(number), "--json")
            self.tree_of("sweep", data, {"run": number, "units": facts.Units(self.meaning, False).name, "set": wanted}, units)
            words = self.run("sweep", name, "--run", str(number)).stdout.split()
            pairs = dict(word.split("=") for word in words[1::2])
            self.same("sweep run", (set(words[::2]), set(pairs)), ({"--set"}, set(wanted)))
            for path, text in pairs.items():
                q = wanted.get(path)
                value = q.value if isinstance(q, facts.Q) else q
                self.near(f"sweep run {path}", float(text), value, 4e-15 * abs(value))

    def go(self):
        axes = self.check()
        title = self.tree.get("title")
        scales = [False] + ([True] if mechanics.norm(self.meaning.machine.gravity) > 0 else [])
        run = verbs.Forces(self.meaning, axes)
        for scaled in scales:
            self.verb(run, title, scaled, reactions=scaled)
        try:
            self.moved(axes, title, scales)
        except verbs.Singular:
            self.singular()

    def singular(self):
        """The motion passes a singular pose, in the study or in a run of its sweep: that much must be said."""
        self.skipped["simulate, sweep"] = "of motions through a singular pose only their end is compared"
        name = os.path.basename(self.path)
        if self.number % 2 == 0:
            data = self.data("simulate", name, "--json", allowed=(0, 1))
        if self.number % 2 or data["end"]["status"] == "done":
            data = self.data("sweep", name, "--json")
            self.same("sweep: a run ends at a singular pose", data.get("ended", {}).get("singular", 0) > 0, True)
        else:
            self.same("simulate: end at a singular pose", data["end"]["status"], "singular")

    def moved(self, axes, title, scales):
        """What moves under forces: simulate and sweep."""
        if self.number % 2 == 0:
            run = verbs.Simulate(self.meaning, axes)
            for scaled in scales:
                self.verb(run, title, scaled, reactions=not scaled)
        if "sweep" in self.tree:
            sweep = sweeps.Sweep(self.tree, verbs.Simulate)
            for scaled in scales:
                self.sweep(sweep, scaled)
            self.settings(sweep)


class Draws(Case):
    """A sweep of many runs of no length: random numbers of both distributions, far into the tails."""

    RUNS = 3000

    def __init__(self, gough, seed, folder):
        self.gough, self.number, self.folder = gough, "draws", folder
        self.compared, self.failures, self.skipped, self.worst = collections.Counter(), [], {}, collections.defaultdict(float)
        self.tree = {"platform": {"base": {"radius": 1.0, "half_angle": 10.0}, "top": {"radius": 0.6, "half_angle": 8.0}, "height": 1.0},
                     "load": {"mass": 1.0, "inertia": [0.1, 0.1, 0.1]},
                     "simulation": {"duration": 1e-3, "output_step": 1e-3, "method": "rk4", "step": 1e-3},
                     "sweep": {"runs": self.RUNS, "seed": seed + 2 ** 40,
                               "keys": {"initial.roll": {"normal": [0, 1]}, "initial.heave": {"uniform": [-1e-3, 2e-3]},
                                        "initial.yaw": {"normal": [1, 0.5]}}}}
        with open(os.path.join(folder, "draws.yaml"), "w", encoding="utf-8") as stream:
            stream.write(studies.written(self.tree))

    def go(self):
        self.run("sweep", "draws.yaml", "-q", "-o", "draws.csv")
        with open(os.path.join(self.folder, "draws.csv"), encoding="utf-8") as stream:
            lines = list(csv.DictReader(stream))
        wanted = sweeps.runs_of(self.tree["sweep"])
        self.same("sweep csv number of rows", len(lines), len(wanted))
        for line, settings in zip(lines, wanted):
            for path, value in settings.items():
                self.near(f"sweep csv draw of {path}", float(line[path]), value, 1e-14)


def one(gough, seed, number, keep):
    with tempfile.TemporaryDirectory() as scratch:
        folder = keep or scratch
        case = Draws(gough, seed, folder) if number is None else Case(gough, seed, number, folder)
        try:
            case.go()
        except StopIteration:
            pass
        except Exception as error:  # a study that cannot be computed is a failure of the campaign, told with its number
            import traceback
            case.fail(f"the campaign itself fails: {error!r}\n{traceback.format_exc()}")
        return case.compared, case.failures, case.skipped, dict(case.worst)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gough", required=True)
    parser.add_argument("--studies", type=int, default=50)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", help="a folder for the studies")
    parser.add_argument("--show", type=int, default=8, help="differences told of each study")
    parser.add_argument("--worst", action="store_true", help="print which share of its slack each kind of number took")
    options = parser.parse_args()
    os.environ["LC_ALL"] = "C"
    gough = os.path.abspath(options.gough)
    numbers = range(options.first, options.first + options.studies)
    compared, failures, skipped, worst = collections.Counter(), [], {}, collections.defaultdict(float)
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(one, gough, options.seed, k, options.keep) for k in (None, *numbers)]
        for job in jobs:
            a, b, c, d = job.result()
            compared.update(a)
            failures += b
            skipped.update(c)
            for line in b[:options.show]:
                print("FAIL ", line, flush=True)
            if len(b) > options.show:
                print(f"      and {len(b) - options.show} more of this study (--show N)", flush=True)
            for name, share in d.items():
                worst[name] = max(worst[name], share)
    if options.worst:
        for name, share in sorted(worst.items(), key=lambda x: -x[1])[:60]:
            print(f"  {share:8.1g} {name}")
    print(f"seed {options.seed}, studies {options.first} to {numbers[-1]}: {sum(compared.values())} numbers compared ("
          + ", ".join(f"{verb} {count}" for verb, count in sorted(compared.items())) + f"), {len(failures)} differ")
    for name, reason in sorted(skipped.items()):
        print(f"  not compared: {name}: {reason}")
    sys.exit(1 if failures or not compared else 0)


if __name__ == "__main__":
    main()
