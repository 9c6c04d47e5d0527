#!/usr/bin/env bash
# Moves from limits, as a reader of `gough check` and `gough forces` sees them: durations by hand, the limit that each move reaches in
# the table of forces, and what is refused.
source "$(dirname "$0")/support.sh"
cd "$scratch" || exit 1
cat >moves.yaml <<'END'
title: Moves from limits
units: si
platform:
  base: {radius: 1, half_angle: 8}
  top: {radius: 0.7, half_angle: 10}
  height: 1.1
  legs: {max_speed: 0.25, max_force: 900}
load: {mass: 200, inertia: [20, 20, 30]}
motion:
  moves:
    - {heave: 0.1, speed: 0.2, acceleration: 1}
    - {start: 1.5, heave: 0, yaw: 20, duration: least}
    - {yaw: 0, angular_speed: 20}
    - {surge: 0.2, sway: 0.1, acceleration: 0.5}
    - {surge: 0, sway: 0, heave: 0.15, duration: least}
control: {stiffness: 50000, damping: 3000}
simulation: {duration: 10, output_step: 0.002}
END
run check moves.yaml
expect_code 0 "moves with limits"
# 15/8 of 0.1 m at 0.2 m/s, in the middle
grep -q '^  move 1  *from 0 to 0.9375 s, limited by its own speed, at t = 0.46875 s$' "$out" || fail "move 1: $(grep move "$out")"
grep -q '^  move 2  *from 1.5 to .* s, limited by the speed of leg [1-6], at t = .* s$' "$out" || fail "move 2: $(grep move "$out")"
grep -q '^  move 3  *from .* s, limited by its own angular speed in yaw, at t = .* s$' "$out" || fail "move 3: $(grep move "$out")"
run check moves.yaml --json
run_times=$(python3 - "$out" <<'END'
import json, math, sys
moves = json.load(open(sys.argv[1]))["program"]["moves"]
def near(a, b, what):
    if not abs(a - b) <= 1e-9 * abs(b):
        print(f"{what} is {a}, not {b}")
near(moves[0]["end"], 0.9375, "end of move 1")
near(moves[2]["start"], moves[1]["end"], "start of move 3")
near(moves[2]["end"] - moves[2]["start"], 15 / 8 * 20 / 20, "duration of move 3")
near(moves[3]["end"] - moves[3]["start"], math.sqrt(10 / math.sqrt(3) * math.hypot(0.2, 0.1) / 0.5), "duration of move 4")
words = [m["limit"] for m in moves]
if words != ["speed", "leg_speed", "angular_speed", "acceleration", words[4]] or words[4] not in ("leg_speed", "leg_force"):
    print(f"limits: {words}")
END
)
[[ -z $run_times ]] || fail "$run_times"
# the table reaches the limits of the legs in moves 2 and 5, and does not pass them
run forces moves.yaml -q -o moves.csv
expect_code 0 "forces"
run check moves.yaml --json
read -r second fifth < <(python3 -c 'import json, sys; m = json.load(open(sys.argv[1]))["program"]["moves"]; print(m[1]["end"], m[4]["start"])' "$out")
used=$(awk -F, -v second="$second" -v fifth="$fifth" '
    NR == 1 { for (i = 1; i <= NF; i++) { if ($i ~ /^dl[1-6]$/) rate[i]; if ($i ~ /^f[1-6]$/) force[i] } next }
    { share = 0
      for (i in rate) { x = $i < 0 ? -$i : $i; if (x / 0.25 > share) share = x / 0.25 }
      for (i in force) { x = $i < 0 ? -$i : $i; if (x / 900 > share) share = x / 900 }
      if ($1 >= 1.5 && $1 <= second && share > two) two = share
      if ($1 >= fifth && share > five) five = share }
    END { printf "%d %d", (two > 0.9999 && two <= 1), (five > 0.9999 && five <= 1) }' moves.csv)
[[ $used == "1 1" ]] || fail "shares of the limits in moves 2 and 5: $used"
# what has no duration
refused() { # refused MOVE SENTENCE
    run check moves.yaml --set "motion.moves=[$1]"
    ((code == 2)) && grep -qF "$2" "$err" || fail "$1: $code, $(head -1 "$err")"
}
refused '{heave: 0.1, duration: fast}' '`motion.moves.1.duration` must be a number such as 1.5, found `fast`'
refused '{heave: 0.1}' '`motion.moves.1.duration` is missing: the duration of the move, or the word least; or give speed or acceleration'
refused '{heave: 0.1, duration: 0.1, speed: 0.2}' '`motion.moves.1.duration` is too short for `motion.moves.1.speed`'
refused '{heave: 0.1, speed: 0}' '`motion.moves.1.speed` must be greater than 0, found 0'
refused '{pitch: 5, speed: 1}' 'no limit bounds this move'
refused '{heave: -1, duration: least}' 'outside its limits however long the move takes'
finish
