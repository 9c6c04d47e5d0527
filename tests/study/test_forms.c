/* Forms that a value of a study cannot have: lists that are too short, too long or empty, mappings in place of numbers, and
 * what stands beside them. Each sentence whole, with line and column. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gough/sweep.h"

#include "study/helpers.h"
#include "support/suite.h"

/* A right study of three lines; what a test adds to the legs, and lines after it. */
static void write_study(char *text, size_t room, const char *legs, const char *more) {
    snprintf(text, room,
             "units: si\n"
             "platform: {height: 1, base: {radius: 1, half_angle: 10}, "
             "top: {radius: 0.5, half_angle: 45}%s}\n"
             "load: {mass: 10, inertia: [1, 1, 1]}\n"
             "%s",
             legs, more);
}

/* The messages without the lines of the source: "line:column: sentence", one a line. */
static void keep_sentences(const char *messages, char *kept, size_t room) {
    static const char head[] = "study.yaml:";
    size_t used = 0;
    kept[0] = '\0';
    for (const char *line = messages; line && *line;) {
        const size_t length = strcspn(line, "\n");
        int row, column, begin = 0;
        if (strncmp(line, head, sizeof head - 1) == 0 &&
            sscanf(line + sizeof head - 1, "%d:%d: error: %n", &row, &column, &begin) == 2) {
            const char *sentence = line + sizeof head - 1 + begin;
            const int said = snprintf(kept + used, room - used, "%d:%d: %.*s\n", row, column,
                                      (int)(line + length - sentence), sentence);
            ck_assert(said > 0 && (size_t)said < room - used);
            used += (size_t)said;
        }
        line += length + (line[length] == '\n');
    }
}

static void expect(const char *legs, const char *more, const char *sentences) {
    char text[4000], kept[4000];
    write_study(text, sizeof text, legs, more);
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_msg(made.status == GOUGH_ERROR_INPUT, "accepted:\n%s", text);
    keep_sentences(made.messages, kept, sizeof kept);
    ck_assert_str_eq(kept, sentences);
    reading_free(&made);
}

START_TEST(legs_have_numbers_in_their_form) {
    expect(", legs: {piston: {mass: abc}}", "",
           "2:116: `platform.legs.piston.mass` must be a number such as 1.5, found `abc`\n");
    expect(", legs: {piston: {mass: 3, centre: 0.2, inertia: 1}}", "",
           "2:119: unknown key `centre`; did you mean `center`?\n");
    expect(", legs: {friction: {breakaway: x, coulomb: 1}}", "",
           "2:123: `platform.legs.friction.breakaway` must be a number such as 1.5, found `x`\n");
    expect(", legs: {friction: {breakaway: 0, coulomb: x}}", "",
           "2:135: `platform.legs.friction.coulomb` must be a number such as 1.5, found `x`\n");
    expect(", legs: {length: 3}", "",
           "2:109: `platform.legs.length` must be a list of two numbers or a list of six such "
           "pairs, found `3`\n");
    expect(", legs: {length: []}", "",
           "2:109: `platform.legs.length` must be a list of two numbers or a list of six such "
           "pairs, found a list of 0\n");
    expect(", legs: {length: {a: 1}}", "",
           "2:109: `platform.legs.length` must be a list of two numbers or a list of six such "
           "pairs, found a mapping\n");
    expect(", legs: {length: {}}", "",
           "2:109: `platform.legs.length` must be a list of two numbers or a list of six such "
           "pairs, found an empty mapping\n");
    expect(", legs: {length: [[1, 2], [1, 2]]}", "",
           "2:109: `platform.legs.length` must be a list of two numbers or a list of six such "
           "pairs, found a list of 2\n");
    expect(", legs: {max_force: [[1, 2], [1, 2]]}", "",
           "2:112: `platform.legs.max_force` must be a number or a list of six numbers, found a "
           "list of 2\n");
    expect(", legs: {max_force: []}", "",
           "2:112: `platform.legs.max_force` must be a number or a list of six numbers, found a "
           "list of 0\n");
    expect(", legs: 3", "",
           "2:100: `platform.legs` must be a mapping of keys to values, found `3`\n");
    expect(", legs: [1]", "",
           "2:100: `platform.legs` must be a mapping of keys to values, found a list\n");
}
END_TEST

START_TEST(drives_are_a_mapping_or_six) {
    expect("", "actuators: []\n",
           "4:12: `actuators` must be a mapping such as {kind: lag, time_constant: 0.005} or a "
           "list of six, found an empty list\n");
    expect("", "actuators: 3\n",
           "4:12: `actuators` must be a mapping such as {kind: lag, time_constant: 0.005} or a "
           "list of six, found `3`\n");
    expect("", "actuators: [{kind: ideal}]\n",
           "4:12: `actuators` must be a mapping such as {kind: lag, time_constant: 0.005} or a "
           "list of six, found a list of 1\n");
    expect("", "actuators: [1, 2, 3, 4, 5, 6]\n",
           "4:13: `actuators.1` must be a mapping such as {kind: lag, time_constant: 0.005}, found "
           "`1`\n"
           "4:16: `actuators.2` must be a mapping such as {kind: lag, time_constant: 0.005}, found "
           "`2`\n"
           "4:19: `actuators.3` must be a mapping such as {kind: lag, time_constant: 0.005}, found "
           "`3`\n"
           "4:22: `actuators.4` must be a mapping such as {kind: lag, time_constant: 0.005}, found "
           "`4`\n"
           "4:25: `actuators.5` must be a mapping such as {kind: lag, time_constant: 0.005}, found "
           "`5`\n"
           "4:28: `actuators.6` must be a mapping such as {kind: lag, time_constant: 0.005}, found "
           "`6`\n");
    expect("", "actuators: {kind: ideal, max_force: [[1, 2], [1, 2]]}\n",
           "4:37: `actuators.max_force` must be a number, a list of two numbers, or a list of six "
           "of these, found a list of 2\n");
    expect("", "actuators: {kind: ideal, max_force: []}\n",
           "4:37: `actuators.max_force` must be a number, a list of two numbers, or a list of six "
           "of these, found a list of 0\n");
    expect("", "actuators: {max_force: {}}\n",
           "4:24: `actuators.max_force` must be a number, a list of two numbers, or a list of six "
           "of these, found an empty mapping\n");
}
END_TEST

START_TEST(lists_have_their_lengths) {
    expect("", "gravity: [[0, 0, -1], [1, 2, 3]]\n",
           "4:10: `gravity` must be a number or a list of three numbers, found a list of 2\n");
    expect("", "gravity: []\n",
           "4:10: `gravity` must be a number or a list of three numbers, found a list of 0\n");
    expect("", "gravity: {}\n",
           "4:10: `gravity` must be a number or a list of three numbers, found an empty mapping\n");
    expect("", "initial: 3\n", "4:10: `initial` must be a mapping of keys to values, found `3`\n");
    expect("", "control: {stiffness: []}\n",
           "4:22: `control.stiffness` must be a number, a list of six numbers or a 6×6 matrix "
           "[[…], …], found a list of 0\n");
    expect("", "control: {stiffness: [[]]}\n",
           "4:22: `control.stiffness` must be a number, a list of six numbers or a 6×6 matrix "
           "[[…], …], found a list of 1\n");
    expect("", "control: {stiffness: [[1], [2], [3], [4], [5], [6]]}\n",
           "4:23: `control.stiffness.1` must be a list of six numbers, found a list of 1\n"
           "4:28: `control.stiffness.2` must be a list of six numbers, found a list of 1\n"
           "4:33: `control.stiffness.3` must be a list of six numbers, found a list of 1\n"
           "4:38: `control.stiffness.4` must be a list of six numbers, found a list of 1\n"
           "4:43: `control.stiffness.5` must be a list of six numbers, found a list of 1\n"
           "4:48: `control.stiffness.6` must be a list of six numbers, found a list of 1\n");
    expect("", "control: {stiffness: {}}\n",
           "4:22: `control.stiffness` must be a number, a list of six numbers or a 6×6 matrix "
           "[[…], …], found an empty mapping\n");
    expect("", "control: {stiffness: [{}, 1, 1, 1, 1, 1]}\n",
           "4:23: `control.stiffness.1` must be a number, found an empty mapping\n");
    expect("", "external: []\n",
           "4:11: `external` must be a list of 1 to 8 loads such as {force: [0, 0, 30]}, found an "
           "empty list\n");
    expect("", "external: {}\n",
           "4:11: `external` must be a list of 1 to 8 loads such as {force: [0, 0, 30]}, found an "
           "empty mapping\n");
    expect("", "external: [3]\n",
           "4:12: `external.1` must be a mapping such as {force: [0, 0, 30]}, found `3`\n");
    expect("", "external: [{force: [1, 2]}]\n",
           "4:20: `external.1.force` must be a list of three formulas, found a list of 2\n");
}
END_TEST

START_TEST(a_design_says_what_may_vary) {
    expect("", "design: 3\n", "4:9: `design` must be a mapping of keys to values, found `3`\n");
    expect("", "design: {}\n",
           "4:1: `design.vary` is missing: the keys that are chosen, by their paths, each with the "
           "least and the greatest value it may take: platform.top.radius: [0.8, 1.9]\n");
    expect("", "design: {vary: 3}\n",
           "4:16: `design.vary` must be a mapping such as {platform.top.radius: [0.8, 1.9]}, found "
           "`3`\n");
    expect("", "design: {vary: {}}\n",
           "4:16: `design.vary` must be a mapping such as {platform.top.radius: [0.8, 1.9]}, found "
           "an empty mapping\n");
    expect("", "design: {vary: []}\n",
           "4:16: `design.vary` must be a mapping such as {platform.top.radius: [0.8, 1.9]}, found "
           "an empty list\n");
    expect("", "design: {vary: {load.mass: 3}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:28: `design.vary.load.mass` must be a list of two numbers, found `3`\n");
    expect(
        "",
        "design: {vary: {load.mass: [1, 2], load.mass: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
        "4:36: duplicate key `load.mass`: it is already set in line 4\n");
    expect("", "design: {vary: {load.mass: [2, 1]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:28: `design.vary.load.mass` must be [least, greatest], the first below the second\n");
    expect("", "design: {vary: {load.mass: [-2, 1]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:29: `design.vary.load.mass.1` must be greater than 0, found -2\n");
    expect("", "design: {vary: {load.mass: [a, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:29: `design.vary.load.mass.1` must be a number such as 1.5, found `a`\n");
    expect("",
           "design: {vary: {load.mass: [1, 2]}, minimize: {force: 0}}\nworkspace: {box: {heave: "
           "0.1}}\n",
           "4:37: `design.minimize` needs a weight greater than 0, as in {force: 1}\n");
    expect("",
           "design: {vary: {load.mass: [1, 2]}, minimize: [1]}\nworkspace: {box: {heave: 0.1}}\n",
           "4:47: `design.minimize` must be force, stroke, speed, footprint or a mapping such as "
           "{force: 1, stroke: 0.5}, found a list\n");
    expect("",
           "design: {vary: {load.mass: [1, 2]}, minimize: foo}\nworkspace: {box: {heave: 0.1}}\n",
           "4:47: `design.minimize` must be one of force, stroke, speed, footprint, found `foo`; "
           "did you mean `footprint`?\n");
    expect("", "design: {vary: {load.mass: [1, 2]}}\n",
           "4:1: `workspace.box` is missing: it is the requirement that a design must meet, as in "
           "workspace: {box: {heave: 0.2, yaw: 10}}\n");
    expect("", "design: {vary: {load.mass: [1, 2]}}\nworkspace: {box: {}}\n",
           "4:1: `workspace.box` is missing: it is the requirement that a design must meet, as in "
           "workspace: {box: {heave: 0.2, yaw: 10}}\n");
    expect("", "design: {vary: {load.mass: [1, 2]}}\nworkspace: {box: 3}\n",
           "5:18: `workspace.box` must be a mapping of keys to values, found `3`\n");
    expect("", "design: {vary: {load.inertia: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: `load.inertia` is not one number but three numbers or 3×3 matrix: vary its "
           "elements, numbered from 1, as in `load.inertia.1`\n");
    expect("", "design: {vary: {external.1.force.1: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: `external.1.force.1`: the study has no list `external` with such an element; add "
           "it to the study\n");
    expect("", "design: {vary: {control.stiffness: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: the study does not give `control.stiffness`; give it a number, from which the "
           "search starts\n");
    expect(", legs: {max_speed: [1, 1, 1, 1, 1, 1]}",
           "design: {vary: {platform.legs.max_speed: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: `platform.legs.max_speed` is not a number in this study; the search starts from "
           "a number\n");
    expect(", legs: {max_speed: [1, 1, 1, 1, 1, 1]}",
           "design: {vary: {platform.legs.max_speed.7: [1, 2], platform.legs.max_speed.x: [1, "
           "2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: `platform.legs.max_speed.7` is not a key of a study; did you mean "
           "`platform.legs.max_speed`?\n"
           "4:52: `platform.legs.max_speed.x` is not a key of a study; did you mean "
           "`platform.legs.max_speed`?\n");
    expect("",
           "control: {stiffness: x}\ndesign: {vary: {control.stiffness: [1, 2]}}\nworkspace: {box: "
           "{heave: 0.1}}\n",
           "4:22: `control.stiffness` must be a number such as 1.5, found `x`\n");
    expect("", "design: {vary: {motion.heave: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: the study does not give `motion.heave`; give it a number, from which the search "
           "starts\n");
    expect("", "design: {vary: {simulation.duration: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: the study does not give `simulation.duration`; give it a number, from which the "
           "search starts\n");
    expect("", "design: {vary: {workspace.box.heave: [1, 2]}}\nworkspace: {box: {heave: 0.1}}\n",
           "4:17: `workspace.box.heave` belongs to the requirement that a design must meet, and "
           "cannot vary\n");
}
END_TEST

START_TEST(what_varies_is_a_number_of_the_study) {
    expect("", "sweep: {keys: {load.mass.1: [1, 2]}}\n",
           "4:16: `load.mass.1` is not a key of a study; did you mean `load.mass`?\n");
    expect("", "sweep: {keys: {actuators.kind: [1, 2]}}\n",
           "4:16: `actuators.kind` is not a number (choice) and cannot vary\n");
    expect("", "sweep: {keys: {actuators.1.max_force: [1, 2]}}\n",
           "4:16: `actuators.1.max_force`: the study has no list `actuators` with such an element; "
           "add it to the study\n");
    expect("", "sweep: {keys: {actuators.max_force.1: [1, 2]}}\n",
           "4:16: `actuators.max_force.1`: the study has no list `actuators.max_force` with such "
           "an element; add it to the study\n");
    expect("", "actuators: {max_force: 3}\nsweep: {keys: {actuators.1.max_force: [1, 2]}}\n",
           "5:16: `actuators.1.max_force`: the study has no list `actuators` with such an element; "
           "add it to the study\n");
    expect("", "actuators: {max_force: 3}\nsweep: {keys: {actuators.max_force.1: [1, 2]}}\n",
           "5:16: `actuators.max_force.1`: the study has no list `actuators.max_force` with such "
           "an element; add it to the study\n");
    expect("",
           "actuators: [{max_force: 3}, {max_force: 3}, {max_force: 3}, {max_force: 3}, "
           "{max_force: 3}, {max_force: 3}]\nsweep: {keys: {actuators.max_force: [1, 2]}}\n",
           "5:16: `actuators.max_force`: `actuators` is a list in this study; vary the number of "
           "one leg, as in `actuators.1.max_force`\n");
    expect("",
           "actuators: [{max_force: 3}, {max_force: 3}, {max_force: 3}, {max_force: 3}, "
           "{max_force: 3}, {max_force: 3}]\nsweep: {keys: {actuators.7.max_force: [1, 2]}}\n",
           "5:16: `actuators.7.max_force`: the study has no list `actuators` with such an element; "
           "add it to the study\n");
    expect("",
           "actuators: [{max_force: 3}, {max_force: 3}, {max_force: 3}, {max_force: 3}, "
           "{max_force: 3}, {max_force: 3}]\nsweep: {keys: {actuators.1.max_force.1: [1, 2]}}\n",
           "5:16: `actuators.1.max_force.1`: the study has no list `actuators.1.max_force` with "
           "such an element; add it to the study\n");
    expect("",
           "actuators: [{max_force: 3}, {max_force: 3}, {max_force: 3}, {max_force: 3}, "
           "{max_force: 3}, {max_force: 3}]\nsweep: {keys: {actuators.1.kind: [1, 2]}}\n",
           "5:16: `actuators.1.kind` is not a number (choice) and cannot vary\n");
    expect("", "external: [{force: [1, 1, 1]}]\nsweep: {keys: {external.2.force.1: [1, 2]}}\n",
           "5:16: `external.2.force.1`: the study has no list `external` with such an element; add "
           "it to the study\n");
    expect("", "external: [{force: [1, 1, 1]}]\nsweep: {keys: {external.1.moment.1: [1, 2]}}\n",
           "5:16: `external.1.moment.1`: the study has no list `external.1.moment` with such an "
           "element; add it to the study\n");
    expect("", "external: [{force: [1, 1, 1]}]\nsweep: {keys: {external.force.1: [1, 2]}}\n",
           "5:16: `external.force.1` is not a key of a study; did you mean `external.N.force`?\n");
    expect(
        "", "external: [{force: [1, 1, 1]}]\nsweep: {keys: {external.1.force.4: [1, 2]}}\n",
        "5:16: `external.1.force.4` is not a key of a study; did you mean `external.N.force`?\n");
    expect("", "external: [{force: [1, 1, 1]}]\nsweep: {keys: {external.1.force: [1, 2]}}\n",
           "5:16: `external.1.force` is not one number but three formulas: vary its elements, "
           "numbered from 1, as in `external.1.force.1`\n");
    expect("", "external: {force: 1}\nsweep: {keys: {external.1.force.1: [1, 2]}}\n",
           "4:11: `external` must be a list of 1 to 8 loads such as {force: [0, 0, 30]}, found a "
           "mapping\n"
           "5:16: `external.1.force.1`: the study has no list `external` with such an element; add "
           "it to the study\n");
    expect("", "sweep: {keys: {external.1.force.1: [1, 2]}}\n",
           "4:16: `external.1.force.1`: the study has no list `external` with such an element; add "
           "it to the study\n");
    expect("", "sweep: {keys: {motion.moves.1.start: [1, 2]}}\n",
           "4:16: `motion.moves.1.start`: the study has no list `motion.moves` with such an "
           "element; add it to the study\n");
    expect("", "sweep: {keys: {load.center_of_mass.1: [1, 2]}}\n",
           "4:16: `load.center_of_mass.1`: the study has no list `load.center_of_mass` with such "
           "an element; add it to the study\n");
    expect("", "sweep: {keys: {load.center_of_mass: [1, 2]}}\n",
           "4:16: `load.center_of_mass` is not one number but three numbers: vary its elements, "
           "numbered from 1, as in `load.center_of_mass.1`\n");
    expect("", "sweep: {keys: {platform.legs.length.1: [1, 2]}}\n",
           "4:16: `platform.legs.length.1`: the study has no list `platform.legs.length` with such "
           "an element; add it to the study\n");
    expect("", "sweep: {keys: {platform.legs.length: [1, 2]}}\n",
           "4:16: `platform.legs.length` is not one number but two numbers or six pairs: vary its "
           "elements, numbered from 1, as in `platform.legs.length.1`\n");
    expect(", legs: {length: [0.5, 2]}", "sweep: {keys: {platform.legs.length: [1, 2]}}\n",
           "4:16: `platform.legs.length` is not one number but two numbers or six pairs: vary its "
           "elements, numbered from 1, as in `platform.legs.length.1`\n");
    expect(", legs: {length: [0.5, 2]}", "sweep: {keys: {platform.legs.length.1.1: [1, 2]}}\n",
           "4:16: `platform.legs.length.1.1`: the study has no list `platform.legs.length` with "
           "such an element; add it to the study\n");
    expect(", legs: {length: [0.5, 2]}", "sweep: {keys: {platform.legs.length.x: [1, 2]}}\n",
           "4:16: `platform.legs.length.x` is not a key of a study; did you mean "
           "`platform.legs.length`?\n");
}
END_TEST

START_TEST(an_order_of_angles_is_one_of_two) {
    expect("", "motion: {order: abc, heave: 0}\n",
           "4:17: `motion.order` must be one of zyx, xyz, found `abc`\n");
    expect("", "motion: {order: abc, samples: none.csv}\n",
           "4:17: `motion.order` must be one of zyx, xyz, found `abc`\n"
           "4:31: cannot open `none.csv`: No such file or directory\n");
    expect("", "motion: {order: , samples: none.csv}\n",
           "4:10: `motion.order` must be one of zyx, xyz, found nothing\n"
           "4:28: cannot open `none.csv`: No such file or directory\n");
}
END_TEST

/* What follows the comma in a formula without quotes. */
START_TEST(a_comma_in_a_formula_is_refused) {
    static const char *const doubtful[] = {
        "motion: {heave: atan2(t, \"1)\"}\n",
        "motion: {heave: atan2(t, {a: 1})}\n",
        "motion: {heave: atan2(t, x: 1)}\n",
        "motion: {heave: atan2(t,, 1)}\n",
        "disturbance: {leg_force: [atan2(t, \"1)\", 0, 0, 0, 0]}\n",
        "disturbance: {leg_force: [atan2(t, [1)], 0, 0, 0, 0]}\n",
        "disturbance: {leg_force: [atan2(t, {a: 1}, 0, 0, 0, 0]}\n",
    };
    for (size_t i = 0; i < sizeof doubtful / sizeof doubtful[0]; i++) {
        char text[4000];
        write_study(text, sizeof text, "", doubtful[i]);
        reading made = read_bytes(text, strlen(text), NULL);
        ck_assert_msg(made.status == GOUGH_ERROR_INPUT, "accepted:\n%s", text);
        reading_free(&made);
    }
}
END_TEST

START_TEST(units_are_single_words) {
    static const char *const wrong[] = {"m*s", "m/s", "m^2", "m·s", "x"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char text[200], part[100];
        snprintf(text, sizeof text, "units: {length: '%s'}\n", wrong[i]);
        snprintf(part, sizeof part, i < 4 ? "must be a single unit, found `%s`" : "found `%s`",
                 wrong[i]);
        expect_said(text, part);
    }
}
END_TEST

START_TEST(a_design_has_at_most_32_numbers) {
    char text[8000], *end = text;
    end += sprintf(end, "%s", "units: si\nplatform:\n  height: 1\n");
    for (int ring = 0; ring < 2; ring++) {
        end += sprintf(end, "  %s: {joints: [", ring ? "top" : "base");
        for (int n = 0; n < 6; n++)
            end += sprintf(end, "%s[%g, %g, 0]", n ? ", " : "", cos(n + 0.2 * ring * (n % 2)),
                           sin(n + 0.2 * ring * (n % 2)));
        end += sprintf(end, "]}\n");
    }
    end += sprintf(end, "load: {mass: 1, inertia: [1, 1, 1]}\nworkspace: {box: {heave: 0.1}}\n"
                        "design:\n  vary:\n");
    for (int k = 0; k < 33; k++)
        end += sprintf(end, "    platform.%s.joints.%d.%d: [-2, 2]\n", k < 18 ? "base" : "top",
                       k % 18 / 3 + 1, k % 3 + 1);
    expect_said(text, "`design.vary` has 33 keys; at most 32 can vary");
}
END_TEST

/* A typing error in the name of a section is the one fault; that the section is missing is not said too. */
START_TEST(a_misspelled_section_is_not_missing_too) {
    static const char text[] =
        "units: si\nplatform: {height: 1, base: {radius: 1, half_angle: 10}, "
        "top: {radius: 0.5, half_angle: 45}}\nload: {mass: 10, inertia: [1, 1, 1]}\n";
    for (int wrong = 0; wrong < 2; wrong++) {
        char all[1000], *messages = NULL;
        gough_design_study *design = NULL;
        snprintf(all, sizeof all, "%s%s", text,
                 wrong ? "desing: {vary: {load.mass: [1, 2]}}\n" : "");
        ck_assert_int_eq(
            gough_design_study_parse("study.yaml", all, strlen(all), NULL, 0, &design, &messages),
            GOUGH_ERROR_INPUT);
        ck_assert_int_eq(occurrences(messages, "has no section `design`"), !wrong);
        ck_assert_int_eq(occurrences(messages, "did you mean `design`?"), wrong);
        gough_study_free_messages(messages);
        gough_design_study_free(design);
    }
}
END_TEST

START_TEST(what_cannot_vary_is_named) {
    expect("", "sweep: {keys: {units: [1, 2]}}\n",
           "4:16: `units` is not a number (choice or mapping) and cannot vary\n");
    expect("", "sweep: {keys: {platform.base.joints: [1, 2]}}\n",
           "4:16: `platform.base.joints` is not one number but six points: vary its elements, "
           "numbered from 1, as in `platform.base.joints.1.1`\n");
}
END_TEST

/* The order of the angles is found wrong before the file that has them is read. */
START_TEST(an_order_beside_a_record_is_checked) {
    static const char csv[] = "t,heave\n0,0\n1,0\n";
    char text[4000], more[1000], *path = write_file("motion.csv", csv, sizeof csv - 1);
    snprintf(more, sizeof more, "motion: {order: abc, samples: '%s'}\n", path);
    write_study(text, sizeof text, "", more);
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_int_eq(occurrences(made.messages, "error:"), 1);
    ck_assert_ptr_nonnull(strstr(made.messages, "`motion.order` must be one of zyx, xyz"));
    reading_free(&made);
    forget_file(path);
}
END_TEST

/* A setting without a value takes a key away, in elements of lists too; a name that no key has is refused. */
START_TEST(settings_take_keys_of_elements_away) {
    static const char *const lists[] = {"external: [{force: [1, 1, 1]}]\n",
                                        "actuators: [{}, {}, {}, {}, {}, {}]\n",
                                        "motion: {moves: [{start: 0, duration: 1, heave: 0.1}]}\n"};
    static const char *const known[] = {
        "external.1.axes=", "actuators.1.max_rate=", "motion.moves.1.yaw="};
    static const char *const unknown[] = {
        "external.1.xyz=", "actuators.1.xyz=", "motion.moves.1.xyz="};
    for (size_t i = 0; i < 3; i++) {
        char text[4000];
        write_study(text, sizeof text, "", lists[i]);
        reading made = read_bytes(text, strlen(text), SETTINGS(known[i]));
        ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
        reading_free(&made);
        made = read_bytes(text, strlen(text), SETTINGS(unknown[i]));
        ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
        ck_assert_msg(strstr(made.messages, "unknown key `xyz`"), "%s", made.messages);
        reading_free(&made);
    }
}
END_TEST

/* What varies may be a formula of the motion, whose value in the file is a number. */
START_TEST(a_design_may_vary_a_number_of_the_motion) {
    char text[4000];
    write_study(text, sizeof text, "",
                "motion: {heave: 3}\nworkspace: {box: {heave: 0.1}}\n"
                "design: {vary: {motion.heave: [1, 4]}}\n");
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    reading_free(&made);
}
END_TEST

/* The known loads of a study whose numbers vary are read again in their place. */
START_TEST(known_loads_vary_in_a_sweep) {
    char text[4000], *messages = NULL;
    gough_sweep *sweep = NULL;
    gough_error error = {.message = ""};
    gough_state home;
    write_study(text, sizeof text, "",
                "external: [{force: [1, 2, 3]}]\nsweep: {keys: {external.1.force.2: [5, 7]}}\n");
    ck_assert_int_eq(
        gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages), GOUGH_OK);
    gough_sweep_maker *maker = gough_sweep_maker_new(sweep);
    for (size_t run = 1; run <= 2; run++) {
        const gough_study *study = NULL;
        gough_wrench wrench;
        ck_assert_int_eq(gough_sweep_make(maker, run, &study, &error), GOUGH_OK);
        home = gough_state_home(&study->model->machine);
        gough_external_wrench(&study->model->machine, &home, 0, &wrench);
        ck_assert_double_eq_tol(wrench.force[1], 3 + 2 * (double)run, 1e-14);
        ck_assert_double_eq_tol(wrench.force[2], 3, 1e-14);
    }
    gough_sweep_maker_free(maker);
    gough_sweep_free(sweep);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/forms", 60, legs_have_numbers_in_their_form,
                     drives_are_a_mapping_or_six, lists_have_their_lengths,
                     a_design_says_what_may_vary, what_varies_is_a_number_of_the_study,
                     an_order_of_angles_is_one_of_two, a_comma_in_a_formula_is_refused,
                     units_are_single_words, a_design_has_at_most_32_numbers,
                     a_misspelled_section_is_not_missing_too, what_cannot_vary_is_named,
                     an_order_beside_a_record_is_checked, settings_take_keys_of_elements_away,
                     a_design_may_vary_a_number_of_the_motion, known_loads_vary_in_a_sweep);
}
