// What happens in a run: limits that the run or its program exceeds, peaks, the pose nearest to a singular one, forces that change
// sign, drives that are held back. Limits and saturation are those that the command has found, between rows too; the others are
// read from the rows.
import { known, number, unitAfter } from "./format.js";

const SIX = [1, 2, 3, 4, 5, 6];
/** Legs whose values differ by less than this share of the greatest are named together. */
const ALIKE = 1e-9;
/** Changes of sign of a leg that are listed; there may be hundreds. */
const MOST_CHANGES = 4;
/** A force below this share of the greatest one has no sign. */
const NO_FORCE = 1e-6;

const names = (legs) =>
  legs.length === 1
    ? `leg ${legs[0]}`
    : legs.length === 6
      ? "all six legs"
      : `legs ${legs.slice(0, -1).join(", ")} and ${legs[legs.length - 1]}`;

/** What the program does beyond a limit, in words. */
const BEYOND = {
  leg_short: (study, legs, limit) => `makes ${legs} shorter than ${number(limit)}${unitAfter(study.unit("l1"))}`,
  leg_long: (study, legs, limit) => `makes ${legs} longer than ${number(limit)}${unitAfter(study.unit("l1"))}`,
  leg_speed: (study, legs, limit) => `moves ${legs} faster than ${number(limit)}${unitAfter(study.unit("dl1"))}`,
  leg_force: (study, legs, limit) => `needs a force beyond the limit of ${number(limit)}${unitAfter(study.unit("f1"))} in ${legs}`,
  leg_acceleration: (_, legs) => `accelerates ${legs} faster than the limit`,
  base_swing: (_, legs) => `turns ${legs} too far at the base`,
  top_swing: (_, legs) => `turns ${legs} too far at the top`,
  platform_pose: (_, __, ___, component) => `leaves the range of ${component}`,
  platform_speed: (_, __, ___, component) => `exceeds the greatest speed of ${component}`,
  platform_acceleration: (_, __, ___, component) => `exceeds the greatest acceleration of ${component}`,
};

/** Limits that the program exceeds; legs that do so together are one event. */
function programEvents(study) {
  const events = [];
  for (const { kind, leg, component, limit, enter, leave } of study.forces?.limits ?? []) {
    if (enter === null || !BEYOND[kind]) continue;
    const near = 1e-6 * (study.duration || 1);
    const same = events.find(
      (event) => event.of === kind && event.bound === limit && leg && Math.abs(event.time - enter) <= near,
    );
    if (same) {
      same.legs.push(leg);
      same.until = Math.max(same.until, leave ?? study.duration);
    } else
      events.push({
        of: kind,
        bound: limit,
        component,
        kind: "limit",
        legs: leg ? [leg] : [],
        time: enter,
        until: leave ?? study.duration,
      });
  }
  return events.map((event) => ({
    ...event,
    text: `The program ${BEYOND[event.of](study, names(event.legs.length ? event.legs : [0]), event.bound, event.component)}`,
  }));
}

/** The end of a run that ended early. */
const endEvents = (study) =>
  study.complete
    ? []
    : [
        {
          kind: "limit",
          time: study.end.time,
          until: study.end.time,
          legs: study.simulate?.end?.legs ?? [],
          text: `The run ends: ${study.end.message || study.end.status}`,
        },
      ];

/** The greatest magnitude of a quantity of the legs in the rows of a run. */
function peakEvent(study, column, figure, words, [minus, plus]) {
  const { run } = study;
  const columns = SIX.map((leg) => run.column(`${column}${leg}`));
  let [row, most] = [0, 0];
  for (let i = 0; i < run.rows; i++)
    for (const values of columns) if (Math.abs(values[i]) > most) [row, most] = [i, Math.abs(values[i])];
  const noise = study.noise(`${column}1`);
  if (most <= noise) return [];
  const legs = SIX.filter((leg) => Math.abs(columns[leg - 1][row]) >= most * (1 - ALIKE));
  const value = columns[legs[0] - 1][row];
  return [
    {
      kind: "peak",
      figure,
      time: run.t[row],
      legs,
      text:
        `Greatest ${words}: ${known(Math.abs(value), noise, 4)}${unitAfter(study.unit(`${column}1`))} ` +
        `(${value < 0 ? minus : plus}), ${names(legs)}`,
    },
  ];
}

/** The pose nearest to a singular one, if the condition number changes at all. */
function conditionEvent(study) {
  const { run } = study;
  const values = run.column("condition");
  let [row, least] = [0, Infinity];
  for (let i = 0; i < run.rows; i++) {
    if (values[i] > values[row]) row = i;
    if (values[i] < least) least = values[i];
  }
  if (!(values[row] > least * (1 + 1e-6))) return [];
  return [
    {
      kind: "peak",
      figure: "condition",
      time: run.t[row],
      legs: [],
      text: `Nearest to a singular pose: condition number ${number(values[row], 4)}`,
    },
  ];
}

/** When the force of a leg changes between push and pull: times between rows, by a straight line. */
function changesOf(t, force, least) {
  const changes = [];
  let before = -1;
  for (let row = 0; row < t.length; row++) {
    if (!(Math.abs(force[row]) > least)) continue;
    if (before >= 0 && force[before] > 0 !== force[row] > 0) {
      const share = force[before] / (force[before] - force[row]);
      changes.push({ time: t[before] + share * (t[row] - t[before]), pull: force[row] < 0 });
    }
    before = row;
  }
  return changes;
}

/** Changes of sign of all legs; those of several legs within half a row are one event. */
function signEvents(study) {
  const { run } = study;
  const least = Math.max(study.noise("f1"), NO_FORCE * study.peakForce);
  const events = [];
  for (const leg of SIX) {
    const changes = changesOf(run.t, run.column(`f${leg}`), least);
    changes.slice(0, MOST_CHANGES).forEach(({ time, pull }, place) => {
      const further = place === MOST_CHANGES - 1 ? changes.length - MOST_CHANGES : 0;
      const same = events.find(
        (event) => event.pull === pull && event.further === further && Math.abs(event.time - time) <= 0.5 * run.step,
      );
      if (same) same.legs.push(leg);
      else events.push({ kind: "sign", figure: "forces", time, pull, further, legs: [leg] });
    });
  }
  return events.map((event) => ({
    ...event,
    text:
      `The force of ${names(event.legs)} turns from ${event.pull ? "push to pull" : "pull to push"}` +
      (event.further ? ` (and ${event.further} more ${event.further > 1 ? "times" : "time"} later)` : ""),
  }));
}

/** Drives that their limits hold back. */
const saturationEvents = (study) =>
  (study.simulate?.legs ?? []).flatMap(({ saturated, saturated_at: at }, index) =>
    at === null || at === undefined
      ? []
      : [
          {
            kind: "limit",
            figure: "forces",
            time: at,
            legs: [index + 1],
            text:
              `The drive of leg ${index + 1} is held back by its limits for the first time; ` +
              `in all ${number(100 * saturated, 2)} % of the time`,
          },
        ],
  );

/** The events of a study in the order of time: [{time, until, kind, figure, legs, text}]. */
export function eventsOf(study) {
  if (!study.run.rows) return [];
  return [
    ...endEvents(study),
    ...programEvents(study),
    ...saturationEvents(study),
    ...peakEvent(study, "f", "forces", study.machine.legs_take_force ? "drive force" : "leg force", [
      "pull",
      "push",
    ]),
    ...peakEvent(study, "dl", "rates", "leg speed", ["shortening", "lengthening"]),
    ...peakEvent(study, "p", "power", "leg power", ["braking", "driving"]),
    ...conditionEvent(study),
    ...signEvents(study),
  ].sort((a, b) => a.time - b.time);
}

/** For each leg, whether an event is about it at a time. @param near how near an event without a length must be. */
export const glowing = (events, time, near) =>
  SIX.map((leg) =>
    events.some(
      (event) => event.legs.includes(leg) && time >= event.time - near && time <= (event.until ?? event.time) + near,
    ),
  );
