#!/usr/bin/env python3
"""coverage.py BUILD [--list] [--readers]: branch coverage of a build with --coverage whose tests have run, by groups of files.

A branch is one way out of a condition in the source. A text that is compiled several times (lanes, quadruple and complex
numbers) is counted once: a branch is taken if any instance takes it. Branches of assertions are not counted. A comment
"unreachable: REASON" stands for one branch of its line that is never taken ("2 unreachable: REASON" for two); their number is
printed, and a comment with fewer such branches on its line is an error. With --list every branch not taken is named, with
--readers only the groups of readers of outside bytes are counted. The exit status is 1 if a group is below its share.
"""
import fnmatch
import json
import os
import re
import subprocess
import sys

# group, least share, files; the first group that fits a file counts it
GROUPS = [
    ("study files", 1, ["src/study/*"]),
    ("tables", 1, ["src/table/read*", "src/table/file_format*", "src/table/child_reader*"]),
    ("parts and shards of sweeps", 1, ["src/sweep/*part*", "src/sweep/*bytes*", "src/sweep/*head*"]),
    ("formulas and numbers", 1, ["src/program/formula*", "src/base/decimal*"]),
    ("options", 1, ["src/cli/common/option*"]),
]
CORE = "base kernel drive program plant control model pose workspace cueing design integrate system run batch linear floquet map tune".split()
GROUPS += [(room, 0, [f"src/{room}/*"]) for room in CORE]
CORE_SHARE = 0.95
ASSERTION = re.compile(r"\bassert(_true)?\(")
UNREACHABLE = re.compile(r"/\* (?:.*? )??(?:([0-9]+) )?unreachable: [^*]")


def notes(build):
    """all of the build, since tests compile texts of headers too"""
    for folder, _, files in os.walk(build):
        yield from (os.path.join(folder, name) for name in files if name.endswith(".gcno"))


def counted(build, source):
    """{file: {(line, function): {number of branches: [count]}}} over all instances"""
    files = {}
    paths = sorted(notes(build))
    if not paths:
        sys.exit(f"coverage.py: {build} is no build with --coverage")
    for begin in range(0, len(paths), 20):
        said = subprocess.run(["gcov", "--branch-probabilities", "--json-format", "--stdout", *paths[begin : begin + 20]],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True, cwd=build).stdout
        for report in said.splitlines():
            for file in json.loads(report)["files"] if report.strip() else []:
                name = os.path.relpath(os.path.join(build, file["file"]), source)
                if not name.startswith("src/"):
                    continue
                lines = files.setdefault(name, {})
                for line in file["lines"]:
                    shape = [branch["count"] for branch in line["branches"]]
                    if shape:
                        shapes = lines.setdefault((line["line_number"], line.get("function_name", "")), {})
                        before = shapes.setdefault(len(shape), [0] * len(shape))
                        shapes[len(shape)] = [a + b for a, b in zip(before, shape)]
    return files


def marked_branches(line):
    """how many branches a line's comment calls unreachable"""
    found = UNREACHABLE.search(line)
    return int(found.group(1) or 1) if found else 0


def lines_of(source, file, lines):
    """(number, text, branches, those not taken) of each line with branches, assertions left out"""
    with open(os.path.join(source, file), encoding="utf-8") as opened:
        text = opened.read().splitlines()
    sums = {}
    for (number, _), shapes in lines.items():
        counts = shapes[max(shapes)]
        before = sums.get(number, (0, 0))
        sums[number] = (before[0] + len(counts), before[1] + sum(count == 0 for count in counts))
    for number, (of, missed) in sorted(sums.items()):
        if number > len(text):
            sys.exit(f"coverage.py: {file} has changed since it was built")
        if not ASSERTION.search(text[number - 1]):
            yield number, text[number - 1], of, missed


def main():
    build, options = os.path.abspath(sys.argv[1]), sys.argv[2:]
    source = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    groups = [group for group in GROUPS if group[1] > 0 or "--readers" not in options]
    total = {name: [0, 0, 0] for name, _, _ in groups}  # taken, reachable, marked
    failed = False
    for file, lines in sorted(counted(build, source).items()):
        group, least = next(((name, least) for name, least, patterns in groups if any(fnmatch.fnmatch(file, p) for p in patterns)), (None, 0))
        if group is None:
            continue
        for number, line, of, missed in lines_of(source, file, lines):
            marked = marked_branches(line)
            if marked > missed:
                failed = True
                print(f"{file}:{number}: called unreachable, but taken: {line.strip()}")
            marked = min(marked, missed)
            total[group][0] += of - missed
            total[group][1] += of - marked
            total[group][2] += marked
            if missed > marked and (least == 1 or "--list" in options):
                print(f"{file}:{number}: {missed - marked} of {of} not taken: {line.strip()}")

    core = [0, 0, 0]
    print(f"{'branches':28} {'taken':>7} {'of':>7} {'share':>8}  unreachable")
    for name, least, _ in groups + ([] if "--readers" in options else [("core", CORE_SHARE, [])]):
        taken, of, marked = total.get(name, core)
        if name in CORE or name == "formulas and numbers":
            core = [a + b for a, b in zip(core, total[name])]
        share = taken / of if of else 1
        low = share < least
        failed |= low
        print(f"{name:28} {taken:7} {of:7} {100 * share:7.2f} %  {marked or ''}{f'  below {100 * least:g} %' if low else ''}")
    return failed


if __name__ == "__main__":
    sys.exit(main())
