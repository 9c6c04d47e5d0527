#!/usr/bin/env bash
# Label: thorough.
# Each panel of each kind of figure of each verb names the unit of its numbers, in SI, dimensionless, and where tables of both are
# compared, and its numbers are in this unit: read from ticks and line, they are those of the table in SI times a factor. Units and
# factors (own-machine: R_b = 0.25 m, M = 6 kg, g = 9.80665 m/s²) are written out here.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
cd "$scratch"

"$GOUGH" example own-machine >study.yaml
set=(--set control.feedforward=none --set simulation.duration=6 --set simulation.output_step=0.05)
"$GOUGH" simulate study.yaml -q "${set[@]}" -o si.h5
"$GOUGH" simulate study.yaml -q "${set[@]}" --dimensionless -o bare.h5
"$GOUGH" sweep study.yaml -q "${set[@]}" --set 'sweep.keys={control.stiffness: {from: 3000, to: 9000, steps: 3}}' -o sweep-si.h5
"$GOUGH" sweep study.yaml -q "${set[@]}" --set 'sweep.keys={control.stiffness: {from: 3000, to: 9000, steps: 3}}' --dimensionless \
    -o sweep-bare.h5

# bare UNIT: the unit of a table without dimensions in words
bare() {
    case $1 in
    m) echo R_b ;; N) echo 'M g' ;; W) echo 'M g √(R_b g)' ;; s) echo '√(R_b/g)' ;; m/s) echo '√(R_b g)' ;; J) echo 'M g R_b' ;; N/m) echo 'M g/R_b' ;;
    esac
}

# headings FIGURE: texts of the picture that name a panel or an axis, one a line
headings() { grep -o '<text>[^<]*</text>' "$1" | sed 's/<[^>]*>//g' | grep -v '^ *$'; }

# The panel that begins with HEADING has UNIT, with any prefix or power of ten; "-": none.
expect() { # expect FIGURE HEADING UNIT
    local line
    line=$(headings "$1" | grep "^$2" | head -1) || fail "$1 has no panel '$2'"
    if [[ $3 == - ]]; then
        [[ $line == "$2" || $line =~ ^"$2"\ \(10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+\)$ ]] || fail "$1: '$line' has a unit"
    else
        [[ $line =~ ^"$2"\ \((10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+\ )?[nµmkMG]?"$3"\)$ ]] || fail "$1: '$line' is not in $3"
    fi
}

units() { # units LABEL m N W s ° m/s TABLE...
    local label=$1 m=$2 N=$3 W=$4 s=$5 rate=$6
    shift 6
    for kind in motion forces lengths rates power deviation drift condition; do
        "$GOUGH" plot "$@" -q --figure $kind -o "$label-$kind.svg"
        if [[ $s == - ]]; then expect "$label-$kind.svg" time -; else expect "$label-$kind.svg" time "$s"; fi
    done
    expect "$label-motion.svg" 'Position x' "$m"
    expect "$label-motion.svg" 'Height z' "$m"
    expect "$label-motion.svg" Pitch °
    expect "$label-forces.svg" 'Leg force' "$N"
    expect "$label-lengths.svg" 'Leg length' "$m"
    expect "$label-rates.svg" 'Leg rate' "$rate"
    expect "$label-power.svg" 'Leg power' "$W"
    expect "$label-deviation.svg" 'Deviation of position from the program' "$m"
    expect "$label-deviation.svg" 'Deviation of angles from the program' °
    "$GOUGH" plot "$@" -q --figure duty -o "$label-duty.svg"
    expect "$label-duty.svg" 'Drive force of each leg' "$N"
    expect "$label-duty.svg" 'leg rate' "$rate"
    expect "$label-drift.svg" 'Constraint drift before projection' -
    expect "$label-condition.svg" 'Condition number of the leg Jacobian' -
}
"$GOUGH" forces study.yaml -q "${set[@]}" -o forces-si.h5
"$GOUGH" forces study.yaml -q "${set[@]}" --dimensionless -o forces-bare.h5
for way in si bare; do
    unit() { if [[ $way == si ]]; then echo "$1"; else bare "$1"; fi; }
    for kind in forces lengths rates power; do "$GOUGH" plot forces-$way.h5 -q --figure $kind -o forces-$way-$kind.svg; done
    expect forces-$way-forces.svg 'Leg force' "$(unit N)"
    expect forces-$way-lengths.svg 'Leg length' "$(unit m)"
    expect forces-$way-rates.svg 'Leg rate' "$(unit m/s)"
    expect forces-$way-power.svg 'Leg power' "$(unit W)"
    expect forces-$way-power.svg time "$(unit s)"
done
units si m N W s m/s si.h5
units bare R_b 'M g' 'M g √(R_b g)' '√(R_b/g)' '√(R_b g)' bare.h5
units mixed - - - - - si.h5 bare.h5
headings mixed-forces.svg | grep -q 'own units' || fail "a figure in mixed units does not say so"
headings si-forces.svg | grep -q 'own units' && fail "a figure in one unit says that there are more"

columns=position_deviation,angle_deviation,force,speed,power,energy
sweep() { # sweep LABEL m N m/s W J N/m TABLE...
    local label=$1 m=$2 N=$3 rate=$4 W=$5 J=$6 G=$7
    shift 7
    "$GOUGH" plot "$@" -q --columns $columns -o "$label-sweep.svg"
    expect "$label-sweep.svg" 'Largest deviation of position from the program' "$m"
    expect "$label-sweep.svg" 'Largest deviation of angle from the program' °
    expect "$label-sweep.svg" 'Largest leg force' "$N"
    expect "$label-sweep.svg" 'Largest leg speed' "$rate"
    expect "$label-sweep.svg" 'Largest leg power' "$W"
    expect "$label-sweep.svg" 'Net work of the legs' "$J"
    expect "$label-sweep.svg" control.stiffness "$G"
}
sweep si m N m/s W J N/m sweep-si.h5
sweep bare R_b 'M g' '√(R_b g)' 'M g √(R_b g)' 'M g R_b' N/m sweep-bare.h5 # keys are in the units of the study
sweep mixed - - - - - N/m sweep-si.h5 sweep-bare.h5

# ---- sweeps over two keys and more --------------------------------------------------------------------------------------

two='sweep.keys={control.stiffness: {from: 3000, to: 9000, steps: 3}, load.mass: {from: 5, to: 7, steps: 3}}'
more='sweep={runs: 6, keys: {control.stiffness: {uniform: [3000, 9000]}, load.mass: {uniform: [5, 7]}, control.damping: {uniform: [5, 50]}}}'
for way in si bare; do
    option=() && [[ $way == si ]] || option=(--dimensionless)
    unit() { if [[ $way == si ]]; then echo "$1"; else bare "$1"; fi; }
    "$GOUGH" sweep study.yaml -q "${set[@]}" "${option[@]}" --set "$two" -o two-$way.h5
    "$GOUGH" plot two-$way.h5 -q --columns $columns -o two-$way.svg
    expect two-$way.svg 'Largest leg force' "$(unit N)"
    expect two-$way.svg 'Largest leg power' "$(unit W)"
    expect two-$way.svg control.stiffness N/m # keys are in the units of the study
    expect two-$way.svg load.mass kg
    "$GOUGH" sweep study.yaml -q "${set[@]}" "${option[@]}" --set "$more" -o more-$way.h5
    "$GOUGH" plot more-$way.h5 -q --columns force -o more-$way.svg
    expect more-$way.svg 'Largest leg force' "$(unit N)"
done

# ---- tuning and maps ----------------------------------------------------------------------------------------------------

for way in si bare; do
    option=() && [[ $way == si ]] || option=(--dimensionless)
    unit() { if [[ $way == si ]]; then echo "$1"; else bare "$1"; fi; }
    "$GOUGH" tune study.yaml -q "${set[@]}" "${option[@]}" --deviation 1e-3 -o tune-$way.h5
    "$GOUGH" plot tune-$way.h5 -q -o tune-$way.svg
    expect tune-$way.svg 'Largest deviation of position' "$(unit m)"
    expect tune-$way.svg 'Largest leg force' "$(unit N)"
    expect tune-$way.svg 'stiffness of the feedback G' "$(unit N/m)"
    map=(--sweep-stiffness 50:500:5) # in units of the study, and soft enough to grow
    "$GOUGH" stability study.yaml -q "${option[@]}" "${map[@]}" -o line-$way.svg -o line-$way.csv
    "$GOUGH" stability study.yaml -q "${option[@]}" "${map[@]}" --sweep-damping 0:100:3 -o plane-$way.svg
    for kind in line plane; do
        headings $kind-$way.svg | grep -qF "stiffness of the feedback G $([[ $way == si ]] && echo '(N/m)' || echo '(M g/R_b)')" ||
            fail "the stiffness of a $kind is in another unit ($way)"
        headings $kind-$way.svg | grep -qF "growth rate $([[ $way == si ]] && echo '(1/s)' || echo '(√(g/R_b))')" ||
            fail "the growth of a $kind is in another unit ($way)"
    done
    headings plane-$way.svg | grep -qF "damping of the feedback D $([[ $way == si ]] && echo '(N s/m)' || echo '(M √(g/R_b))')" ||
        fail "the damping of a map is in another unit ($way)"
done
"$GOUGH" plot tune-si.h5 tune-bare.h5 -q -o tune-mixed.svg
expect tune-mixed.svg 'Largest leg force' -
expect tune-mixed.svg 'stiffness of the feedback G' -

# ---- numbers ------------------------------------------------------------------------------------------------------------

# the greatest number of each line of a figure, in the unit of its heading, against the table in SI
command -v python3 >/dev/null || { echo "no python3: numbers are not compared"; exit 0; }
for way in si bare; do
    for name in forces lengths rates power; do printf '%s\n' "forces-$way-$name.svg forces-si"; done
    for name in forces lengths rates power; do printf '%s\n' "$way-$name.svg si"; done
    printf '%s\n' "$way-sweep.svg sweep-si" "tune-$way.svg tune-si"
done >pictures
"$GOUGH" forces study.yaml -q "${set[@]}" -o forces-si.csv
"$GOUGH" simulate study.yaml -q "${set[@]}" -o si.csv
"$GOUGH" sweep study.yaml -q "${set[@]}" --set 'sweep.keys={control.stiffness: {from: 3000, to: 9000, steps: 3}}' -o sweep-si.csv
"$GOUGH" tune study.yaml -q "${set[@]}" --deviation 1e-3 -o tune-si.csv
python3 - <<'END'
import csv, math, re, sys
R, M, g = 0.25, 6.0, 9.80665
T = math.sqrt(R / g)
unit = {"m": R, "N": M * g, "W": M * g * R / T, "m/s": R / T, "J": M * g * R, "°": 1, "N/m": M * g / R}
legs = lambda name: [f"{name}{leg}" for leg in range(1, 7)]
words_of = {"m": "R_b", "N": "M g", "W": "M g √(R_b g)", "m/s": "√(R_b g)", "J": "M g R_b", "N/m": "M g/R_b", "°": "°"}
heading = {"Leg force": (legs("f"), "N"), "Leg length": (legs("l"), "m"), "Leg rate": (legs("dl"), "m/s"), "Leg power": (legs("p"), "W"),
           "Largest deviation of position from the program": (["position_deviation"], "m"),
           "Largest deviation of angle from the program": (["angle_deviation"], "°"), "Largest leg force": (["force"], "N"),
           "Largest deviation of position": (["position_deviation"], "m"), "Largest leg speed": (["speed"], "m/s"),
           "Largest leg power": (["power"], "W"), "Net work of the legs": (["energy"], "J")}
prefix = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6, "G": 1e9}
raised = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")

def scale_of(words, name):  # what one of a panel's numbers is: "(kN)", "(10⁻³ N)", "(10⁻³)"
    found = re.fullmatch(r"(?:10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+) ?)?(.*)", words)
    scale = 10.0 ** int(found[1].translate(raised)) if found[1] else 1.0
    if found[2] in ("", name): return scale
    assert found[2][1:] == name, words
    return scale * prefix[found[2][0]]

def number(text):
    text = text.replace("−", "-")
    found = re.fullmatch(r"(-?[\d.]+)?·?(?:10\^(-?\d+))?", text)
    return float(found[1] or 1) * 10.0 ** int(found[2] or 0) if found and text else None

def plain(markup):
    return re.sub(r"<[^>]*>", "", re.sub(r'<tspan[^>]*dy="-[^>]*>', "^", markup))

compared = 0
for line in open("pictures"):
    picture, table = line.split()
    svg, rows = open(picture).read(), list(csv.DictReader(open(table + ".csv")))
    bare = "bare" in picture
    # panels from top to bottom: ticks at the left, and the heading before the lines
    ticks = [(float(y), number(plain(text))) for y, text in re.findall(
        r"d='M(?:[\d.]+),([\d.]+) L[\d.]+,\1  '/>\s*<g transform=\"translate\([\d.]+,[\d.]+\)\"[^>]*text-anchor=\"end\"[^>]*>\s*<text>(.*?)</text>", svg)]
    heads = [(m.start(), m[1], m[2] or "") for m in re.finditer(r"<text>([A-Z][^<(]*?)(?: \(([^<]*)\))?</text>", svg) if m[1] in heading]
    # a panel's ticks fall from the bottom up: a new panel begins where the place rises
    panels, last = [], None
    for y, value in ticks:
        if last is None or y > last: panels.append([])
        panels[-1].append((y, value))
        last = y
    assert len(panels) == len(heads), (picture, len(panels), [h[1] for h in heads])
    for panel, (at, words, brackets) in zip(panels, heads):
        columns, name = heading[words]
        scale = scale_of(brackets, words_of[name] if bare else name)
        (y0, v0), (y1, v1) = panel[0], panel[-1]
        low, high = y1 - 300, y0 + 300
        decades = v0 > 0 and len(panel) > 2 and abs(panel[1][1] ** 2 / (panel[0][1] * panel[2][1]) - 1) < 1e-6
        def value_at(y):
            part = (y - y0) / (y1 - y0)
            return v0 * (v1 / v0) ** part if decades else v0 + part * (v1 - v0)
        # lines of this panel: their paths come after its heading, before the next
        ends = [h[0] for h in heads if h[0] > at] + [len(svg)]
        body = svg[at:ends[0]]
        drawn = []
        for path in re.findall(r"<path stroke='rgb\((?! 51,)[^)]*\)'  d='([^']*)'", body):  # not the border
            for part in path.split("M"):  # the sample in the key is another part
                points = re.findall(r"([\d.]+),([\d.]+)", part)
                if len(points) >= 3: drawn += [float(y) for _, y in points]
        if not drawn: continue
        # a run of the curve that ended early has a deviation up to there, and no force
        curve = [row for row in rows if row.get("named", "0") == "0" and not (columns == ["force"] and row.get("ended", "0") == "1")]
        table_values = [float(row[c]) for row in curve for c in columns]
        factor = 1 / unit[name] if bare else 1.0
        wanted = max(table_values) * factor / scale
        found = value_at(min(drawn))
        span = (max(table_values) - min(table_values)) * factor / scale
        room = 0.03 * abs(wanted) if decades else 0.01 * max(span, abs(v1 - v0))
        if abs(found - wanted) > room: sys.exit(f"{picture}, {words} ({brackets}): drawn up to {found:.5g}, the table says {wanted:.5g}")
        compared += 1
if compared < 24: sys.exit(f"only {compared} panels were compared")
END
