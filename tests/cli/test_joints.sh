#!/usr/bin/env bash
# Columns of --joints: the forces on the top accelerate the load, those of the base carry everything, friction opposes the motion;
# legs without mass and friction push along themselves. The summary has the same numbers with and without the columns.
source "$(dirname "$0")/support.sh"
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }
cd "$scratch" || exit 1
cat >legs.yaml <<'END'
units: si
platform:
  base: {radius: 1.5, half_angle: 8}
  top: {radius: 1.1, half_angle: 8}
  height: 2
  legs:
    cylinder: {mass: 60, center: 0.55, inertia: 7}
    piston: {mass: 30, center: 0.7, inertia: 5}
    reflected_mass: 140
    friction: {viscous: 1500, coulomb: 120, smoothing_speed: 0.01}
load: {mass: 1000, center_of_mass: [0, 0, 0], inertia: [400, 500, 450]}
gravity: 10
motion: {surge: "0.1*ramp(t, 1)*sin(2*t)", heave: "0.2*ramp(t, 1)*sin(2*t)", pitch: "5*ramp(t, 1)*sin(3*t)"}
control: {stiffness: 400000, damping: 15000}
simulation: {duration: 3, output_step: 0.1}
END
sed '/^  legs:$/d; /cylinder/d; /piston/d; /reflected/d; /friction/d' legs.yaml >light.yaml
joints=$(for k in 1 2 3 4 5 6; do echo "h$k"; done; for e in t b; do for k in 1 2 3 4 5 6; do for a in x y z; do echo "$e$a$k"; done; done; done; for k in 1 2 3 4 5 6; do echo "s$k"; done)

for verb in forces simulate; do
    for study in legs light; do
        run $verb $study.yaml --json -q
        cp out plain.json
        run $verb $study.yaml --joints --json -o joints.csv
        expect_code 0 "$verb $study --joints"
        cmp -s out plain.json || fail "$verb $study: the summary depends on the columns"
        run $verb $study.yaml -q -o plain.csv
        [[ $(head -1 joints.csv) == "$(head -1 plain.csv),$(paste -sd, <<<"$joints")" ]] || fail "$verb $study: columns $(head -1 joints.csv)"
        cut -d, -f "1-$(head -1 plain.csv | tr ',' '\n' | wc -l)" joints.csv | cmp -s - plain.csv || fail "$verb $study: other columns changed"
        awk -F, -v what="$verb $study" -v study=$study '
            function about(a, b, slack, name) { if (!((a - b < 0 ? b - a : a - b) <= slack)) { print what ", row " NR - 1 ": " name " " a " for " b; bad = 1 } }
            NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
            { split("0 0 10", g, " "); for (c = 1; c <= 3; c++) { axis = substr("xyz", c, 1); top = base = 0
                  for (k = 1; k <= 6; k++) { top += $at["t" axis k]; base += $at["b" axis k] }
                  about(top, 1000 * ($at["a" axis] + g[c]), 1e-3, "sum of t" axis)
                  if (NR == 2) about(base, (study == "legs" ? 1540 : 1000) * g[c], 1e-3, "sum of b" axis) }
              for (k = 1; k <= 6; k++) {
                  f = $at["f" k]; h = $at["h" k]; v = $at["dl" k]; s = $at["s" k]
                  t = sqrt($at["tx" k] ^ 2 + $at["ty" k] ^ 2 + $at["tz" k] ^ 2)
                  if (study == "legs") { about(f - h, 1500 * v + 120 * v / sqrt(v * v + 1e-4), 1e-6, "friction of leg " k)
                      if (!(s > 0)) { print what ": side load " s; bad = 1 } }
                  else { about(f, h, 0, "h" k); about(s, 0, 0, "s" k); about(t, f < 0 ? -f : f, 1e-9 * t, "t" k)
                      about($at["bz" k], $at["tz" k], 0, "bz" k) } } }
            END { exit bad || NR != 32 }' joints.csv >said || fail "$(head -3 said)"
        # peaks of the motion are not below those of its rows, and not far above
        awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
            { for (k = 1; k <= 6; k++) { v = sqrt($at["tx" k] ^ 2 + $at["ty" k] ^ 2 + $at["tz" k] ^ 2); if (v > top[k]) top[k] = v
                v = sqrt($at["bx" k] ^ 2 + $at["by" k] ^ 2 + $at["bz" k] ^ 2); if (v > base[k]) base[k] = v; if ($at["s" k] + 0 > side[k]) side[k] = $at["s" k] + 0 } }
            END { for (k = 1; k <= 6; k++) print top[k], base[k], side[k] + 0 }' joints.csv >rows
        jq -r '.legs[] | "\(.joint_load.top) \(.joint_load.base) \(.side_load)"' plain.json | paste -d' ' - rows |
            awk '{ for (i = 1; i <= 3; i++) if (!($i >= $(i + 3) * (1 - 1e-5) && $i <= 1.05 * $(i + 3))) { print "peak " $i ", of the rows " $(i + 3); bad = 1 } } END { exit bad || NR != 6 }' >said ||
            fail "$verb $study: $(<said)"
    done
done

# what the drives give net and take back, without the summary: powers of many rows
run forces legs.yaml --json -o fine.csv --set simulation.output_step=0.0005
jq -r '.legs[] | "\(.energy) \(.returned_energy) \(.friction_loss) \(.braking_power)"' out >said
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { for (k = 1; k <= 6; k++) { p = $at["p" k]; v = $at["dl" k]; q = (1500 * v + 120 * v / sqrt(v * v + 1e-4)) * v
        if (NR > 2) { net[k] += (p + last[k]) / 2 * 0.0005; back[k] -= ((p < 0 ? p : 0) + (last[k] < 0 ? last[k] : 0)) / 2 * 0.0005; lost[k] += (q + before[k]) / 2 * 0.0005 }
        last[k] = p; before[k] = q; if (-p > most[k]) most[k] = -p } }
    END { for (k = 1; k <= 6; k++) print net[k], back[k], lost[k], most[k] }' fine.csv |
    paste -d' ' said - | awk '{ for (i = 1; i <= 4; i++) { d = $i - $(i + 4); if (!((d < 0 ? -d : d) <= 0.05 && $(i + 4) != 0)) { print "leg " NR ": " $0; bad = 1 } } } END { exit bad || NR != 6 }' >wrong ||
    fail "energies: $(<wrong)"

# dry friction jumps where a leg turns round; the peaks of a run that keeps to its program are those of the program all the same
"$GOUGH" example flight-simulator-legs >flight.yaml
for verb in forces simulate; do "$GOUGH" $verb flight.yaml --json -q | jq -r '.legs[] | "\(.force[0]) \(.force[1]) \(.power[0]) \(.power[1])"' >$verb.txt; done
paste -d' ' forces.txt simulate.txt | awk '{ for (i = 1; i <= 4; i++) { d = $i - $(i + 4); if (!(d * d < 1)) { print "leg " NR ": " $(i + 4) " for " $i; bad = 1 } } } END { exit bad || NR != 6 }' >said ||
    fail "peaks across jumps of friction: $(<said)"

if command -v h5dump >/dev/null; then
    run simulate legs.yaml --joints -q -o joints.h5
    attribute() { h5dump -a "$1" joints.h5 | sed -n 's/^ *(0): "\([^"]*\)".*/\1/p'; }
    for one in 'h3 N force in leg 3 between cylinder and piston, friction taken off, push positive' 'ty2 N force of leg 2 on the top along base y' \
        'bz6 N force of the base on leg 6 along base z' 's1 N side load between cylinder and piston of leg 1'; do
        read -r name unit words <<<"$one"
        [[ $(attribute "/$name/units")$(attribute "/$name/long_name") == "$unit$words" ]] || fail "$name: $(attribute "/$name/units") $(attribute "/$name/long_name")"
    done
fi
finish
