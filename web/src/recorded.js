// The panel beside the scene for recorded runs: pose and leg forces of the moment; for several studies a line each.
import { forceCss, LEGS, studyColor } from "./color.js";
import { element } from "./dom.js";
import { causeWords, fixed, known, number, shower, unit, unitAfter } from "./format.js";
import { eventList, limitsUsed, StrokeBars } from "./happenings.js";
import { verdictOf } from "./stability.js";

const POSE = ["x", "y", "z", "roll", "pitch", "yaw"];

/** Bars of the six leg forces about zero, with the limit and the program's force marked. */
export class ForceBars {
  /** @param words what forces these are; @param noise below what size a force is no more than an error of the run. */
  constructor(words, unitText, peak, limit, noise) {
    const title = words[0].toUpperCase() + words.slice(1);
    this.peak = Math.max(peak, limit && limit < 4 * peak ? limit : 0) || 1;
    this.colorPeak = peak || 1;
    const say = shower(peak);
    this.say = (force) => (Math.abs(force) <= noise ? "0" : say(force));
    this.rows = LEGS.map((color, index) => {
      const bar = element("i", { class: "bar" });
      const plan = element("i", { class: "plan" });
      const value = element("output", { class: "value", "data-testid": `force-${index + 1}` });
      return {
        bar,
        plan,
        value,
        node: element(
          "li",
          {},
          element("span", { class: "leg-name", style: { "--leg": color } }, String(index + 1)),
          element("span", { class: "track" }, bar, plan),
          value,
        ),
      };
    });
    this.node = element(
      "section",
      { class: "bars", "aria-label": title },
      element(
        "h3",
        {},
        title,
        unit(unitText) && element("span", { class: "unit" }, unit(unitText)),
      ),
      element(
        "ol",
        {},
        this.rows.map((row) => row.node),
      ),
    );
  }

  show(forces, plan) {
    this.rows.forEach(({ bar, plan: needle, value }, index) => {
      const force = forces[index];
      const share = Math.max(-1, Math.min(1, force / this.peak)) || 0;
      bar.style.left = `${50 + Math.min(share, 0) * 50}%`;
      bar.style.width = `${Math.abs(share) * 50}%`;
      bar.style.background = forceCss(force / this.colorPeak);
      const wanted = plan?.[index];
      needle.style.display = Number.isFinite(wanted) ? "" : "none";
      if (Number.isFinite(wanted))
        needle.style.left = `${50 + 50 * Math.max(-1, Math.min(1, wanted / this.peak))}%`;
      value.textContent = this.say(force);
    });
  }
}

/** The pose and how far it is from the program. */
export class PoseTable {
  /** @param noise of lengths and of angles. */
  constructor(lengthUnit, angleUnit, size, noise) {
    this.noise = noise;
    const say = [shower(size, 6), (angle) => fixed(angle, 4)];
    this.say = (value, index) => say[index < 3 ? 0 : 1](value);
    this.cells = POSE.map((name) => ({
      name,
      actual: element("td", { "data-testid": `pose-${name}` }),
      off: element("td", { "data-testid": `off-${name}` }),
    }));
    this.node = element(
      "table",
      { class: "pose" },
      element("caption", {}, "Pose of the top"),
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          element("td", {}),
          element("th", { scope: "col" }, "actual"),
          element("th", { scope: "col" }, "off program"),
        ),
      ),
      element(
        "tbody",
        {},
        this.cells.map(({ name, actual, off }, index) => {
          const words = unit(index < 3 ? lengthUnit : angleUnit);
          return element(
            "tr",
            {},
            element(
              "th",
              { scope: "row" },
              name,
              words && element("span", { class: "unit" }, words),
            ),
            actual,
            off,
          );
        }),
      ),
    );
  }

  show(values, deviations) {
    this.cells.forEach(({ actual, off }, index) => {
      actual.textContent = this.say(values[index], index);
      off.textContent = known(deviations[index], this.noise[index < 3 ? 0 : 1], 3);
    });
  }
}

/** What one wants to know first. */
function glance(study) {
  const { simulate, stability } = study;
  if (!simulate?.legs) return null;
  const forces = simulate.legs.flatMap((leg) => leg.force);
  const lengths = simulate.legs.flatMap((leg) => leg.length);
  const pairs = [
    [
      "off program, at most",
      `${study.most(simulate.deviation?.position, "ex", 3)}${unitAfter(study.unit("ex"))}`,
    ],
    ["off in angle, at most", `${study.most(simulate.deviation?.angle, "eroll", 3)} °`],
    [
      study.forceWords,
      `${study.say(Math.min(...forces), "f1", 4)} … ${study.say(Math.max(...forces), "f1", 4)}${unitAfter(study.unit("f1"))}`,
    ],
    [
      "leg lengths",
      `${number(Math.min(...lengths), 4)} … ${number(Math.max(...lengths), 4)}${unitAfter(study.unit("l1"))}`,
    ],
    ["condition, at most", number(simulate.condition, 4)],
    stability && [
      stability.multipliers?.length ? "about the program" : "at rest",
      { stays: "no mode grows", drifts: "a mode drifts away", grows: "a mode grows" }[
        verdictOf(stability)
      ],
    ],
  ];
  return element(
    "section",
    { class: "glance" },
    element("h3", {}, "Over the whole run"),
    element(
      "dl",
      { class: "live-facts" },
      pairs
        .filter(Boolean)
        .map(([term, value]) => [element("dt", {}, term), element("dd", {}, value)]),
    ),
  );
}

/** Panel of one study. */
export class StudyPanel {
  /** @param events of the study; @param go called with an event that is clicked. */
  constructor(study, events, go) {
    this.study = study;
    this.strokes = StrokeBars.of(study);
    this.pose = new PoseTable(study.unit("x"), study.unit("roll"), study.machine.base_radius, [
      study.noise("ex"),
      study.noise("eroll"),
    ]);
    this.bars = new ForceBars(
      study.forceWords,
      study.unit("f1"),
      study.peakForce,
      study.machine.limits?.force,
      study.noise("f1"),
    );
    this.over = element(
      "p",
      { class: "note", "data-testid": "over", role: "status", hidden: true },
      `The run ended at t = ${number(study.end.time, 6)}${unitAfter(study.unit("t"))}. After that there is only the program.`,
    );
    this.node = element(
      "div",
      {},
      this.over,
      element(
        "div",
        { class: "two" },
        element("div", {}, this.bars.node, this.strokes?.node),
        this.pose.node,
      ),
      eventList(study, events, go),
      element("div", { class: "two" }, glance(study), limitsUsed(study)),
    );
  }

  show(time) {
    const { run, plan } = this.study;
    const over = this.study.isOver(time);
    const row = run.rows ? run.t[run.at(Math.min(time, this.study.lastTime)).row] : 0;
    const shown =
      Math.abs(time - row) < 1e-6 * Math.max(1, time) ? row : Math.min(time, this.study.lastTime);
    const now = (name) => (over ? NaN : run.value(name, shown));
    this.over.hidden = !over;
    this.pose.show(POSE.map(now), ["ex", "ey", "ez", "eroll", "epitch", "eyaw"].map(now));
    this.bars.show(
      [1, 2, 3, 4, 5, 6].map((leg) => now(`f${leg}`)),
      [1, 2, 3, 4, 5, 6].map((leg) => plan.value(`f${leg}`, time)),
    );
    this.strokes?.show([1, 2, 3, 4, 5, 6].map((leg) => now(`l${leg}`)));
  }
}

/** Panel of all studies. */
export class ComparisonPanel {
  constructor(studies, choose) {
    this.rows = studies.map((study) => {
      const deviation = element("output", {});
      const angle = element("output", {});
      const forces = element("output", {});
      const state = element("span", { class: "state" });
      const node = element(
        "section",
        { class: "contender", style: { "--study": studyColor(study.index) } },
        element(
          "h3",
          {},
          element(
            "button",
            { type: "button", class: "link", onclick: () => choose(study.index) },
            study.label,
          ),
        ),
        state,
        element(
          "dl",
          {},
          element("dt", {}, "off program"),
          element("dd", {}, deviation, unitAfter(study.unit("ex"))),
          element("dt", {}, "off in angle"),
          element("dd", {}, angle, " °"),
          element("dt", {}, study.forceWords),
          element("dd", {}, forces, unitAfter(study.unit("f1"))),
          element("dt", {}, "off, at most"),
          element(
            "dd",
            {},
            `${study.most(study.simulate?.deviation?.position, "ex", 3)}${unitAfter(study.unit("ex"))}`,
          ),
        ),
      );
      return { study, deviation, angle, forces, state, node };
    });
    this.node = element(
      "div",
      { class: "contenders" },
      this.rows.map((row) => row.node),
    );
  }

  show(time) {
    for (const { study, deviation, angle, forces, state } of this.rows) {
      const { run } = study;
      const over = study.isOver(time);
      const at = (names) => names.map((name) => (over ? NaN : run.value(name, time)));
      deviation.textContent = study.within(Math.hypot(...at(["ex", "ey", "ez"])), "ex", 3);
      angle.textContent = study.within(Math.hypot(...at(["eroll", "epitch", "eyaw"])), "eroll", 3);
      const six = at(["f1", "f2", "f3", "f4", "f5", "f6"]);
      const ends = [Math.min(...six), Math.max(...six)].map((force) => study.say(force, "f1", 3));
      forces.textContent = over
        ? "–"
        : ends[0] === ends[1]
          ? `all ${ends[0]}`
          : ends.join(" … ");
      const ended = over || (!study.complete && time >= study.lastTime);
      state.textContent = ended ? `ended: ${causeWords(study.end.status)}` : "";
    }
  }
}
