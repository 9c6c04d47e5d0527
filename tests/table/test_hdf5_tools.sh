#!/usr/bin/env bash
# HDF5 as others see it: h5dump and netCDF's ncdump know nothing of this program's reader.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
for tool in h5dump ncdump; do
    command -v $tool >/dev/null || fail "$tool is missing (Debian packages hdf5-tools and netcdf-bin)"
done

"$GOUGH" example paper-feedback >"$scratch/study.yaml"
"$GOUGH" simulate "$scratch/study.yaml" -q --set simulation.duration=2 --reactions -o "$scratch/run.h5"
"$GOUGH" simulate "$scratch/study.yaml" -q --set simulation.duration=2 --reactions -o "$scratch/run.csv"

# the columns stand in the order of the CSV, all on the dimension t
ncdump -h "$scratch/run.h5" >"$scratch/header"
grep -q $'^\tt = 41 ;' "$scratch/header" || fail "t is not a dimension of 41 rows"
columns=$(sed -n 's/^\tdouble \([a-z0-9]*\)(t) ;/\1/p' "$scratch/header" | paste -sd,)
[[ $columns == "$(head -1 "$scratch/run.csv")" ]] || fail "columns are $columns"

# what stands at the root, in this order
attributes=$(sed -n 's/^\t\t:\([a-z_]*\) = .*/\1/p' "$scratch/header" | paste -sd' ')
[[ $attributes == "title study software version verb end_time end_cause end_message tolerance" ]] || fail "attributes are $attributes"
grep -q ':title = "The paper' "$scratch/header" || fail "no title"
grep -q ':verb = "simulate"' "$scratch/header" || fail "no verb"
grep -q ':end_time = 2\.' "$scratch/header" || fail "no end_time"
grep -q ':end_cause = "done"' "$scratch/header" || fail "no end_cause"
grep -q '^.*:tolerance = 1.e-12 ;' "$scratch/header" || fail "no tolerance: $(grep ":tolerance" "$scratch/header")"
version=$("$GOUGH" --version | grep -oE '[0-9]+\.[0-9]+\.[0-9]+' | head -1)
grep -q ":version = \"$version\"" "$scratch/header" || fail "version is not $version"

# each column has a unit and a name in words
for attribute in units long_name; do
    count=$(grep -c ":$attribute = \"..*\"" "$scratch/header")
    [[ $count == 57 ]] || fail "$count of 57 columns have $attribute"
done
grep -q 'roll:units = "degree"' "$scratch/header" || fail "roll is not in degrees"
grep -q 'f1:units = "1"' "$scratch/header" || fail "a dimensionless force has a unit"

# the study's text, every character
h5dump -a /study "$scratch/run.h5" >"$scratch/study.txt"
grep -q 'stiffness' "$scratch/study.txt" || fail "the study's text is not kept"

# the numbers, bit for bit: h5dump writes them as raw doubles, the CSV's are made raw by od's inverse
h5dump -d /f3 -b LE -o "$scratch/f3.bin" "$scratch/run.h5" >/dev/null
column=$(head -1 "$scratch/run.csv" | tr ',' '\n' | grep -nx f3 | cut -d: -f1)
od -An -v -w8 -t f8 "$scratch/f3.bin" | awk '{ printf "%.17g\n", $1 }' >"$scratch/f3.hdf5"
tail -n +2 "$scratch/run.csv" | cut -d, -f"$column" >"$scratch/f3.csv"
paste "$scratch/f3.hdf5" "$scratch/f3.csv" | awk '{ d = $1 - $2; if (d < 0) d = -d; if (!(d <= 1e-15 * 1)) bad++ }
    END { if (NR != 41 || bad) exit 1 }' || fail "f3 differs between HDF5 and CSV"

# links and attributes keep the order of their creation, and no object carries a time
h5dump -H -p "$scratch/run.h5" >/dev/null || fail "h5dump cannot read the properties"
order=$(h5dump -n --sort_by=creation_order "$scratch/run.h5" | awk '$1 == "dataset" { print substr($2, 2) }' | paste -sd,)
[[ $order == "$columns" ]] || fail "the order of creation is not kept"

# the same run, the same bits
"$GOUGH" simulate "$scratch/study.yaml" -q --set simulation.duration=2 --reactions -o "$scratch/again.h5"
cmp "$scratch/run.h5" "$scratch/again.h5" || fail "two runs differ"

# a run of fixed steps has its step, in the table's unit of time, and no tolerance: √(0.25/9.80665) s are one of √(R_b/g)
"$GOUGH" example own-machine >"$scratch/own.yaml"
fixed=(--set simulation.duration=0.2 --set simulation.method=rk4 --set simulation.step=0.005 --set simulation.output_step=0.05)
"$GOUGH" simulate "$scratch/own.yaml" -q "${fixed[@]}" -o "$scratch/si.h5"
"$GOUGH" simulate "$scratch/own.yaml" -q "${fixed[@]}" --dimensionless -o "$scratch/bare.h5"
step_of() { h5dump -a /step "$1" | awk '/\(0\):/ { print $2 }'; }
awk -v si="$(step_of "$scratch/si.h5")" -v bare="$(step_of "$scratch/bare.h5")" 'BEGIN {
    wanted = 0.005 / sqrt(0.25 / 9.80665)
    exit !(si == 0.005 && bare > wanted * 0.99999 && bare < wanted * 1.00001) }' || fail "the step of a fixed stepper is wrong"
ncdump -h "$scratch/si.h5" >"$scratch/header"
grep -q ':tolerance' "$scratch/header" && fail "a run of fixed steps has a tolerance"
"$GOUGH" tune "$scratch/own.yaml" -q --deviation 1e-2 --set simulation.tolerance=1e-8 --set simulation.duration=2 -o "$scratch/tune.h5"
ncdump -h "$scratch/tune.h5" >"$scratch/header"
grep -q ':tolerance = 1.e-08 ;' "$scratch/header" || fail "tuning does not name its tolerance"
