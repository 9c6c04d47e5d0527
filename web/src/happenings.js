// The parts of the panel about events and limits: a list of events to click, strokes between both stops, and how much of each
// limit a run uses.
import { LEGS } from "./color.js";
import { element } from "./dom.js";
import { fixed, number, shower, unit, unitAfter } from "./format.js";

/** Events of a study as a list; @param go called with the event that is clicked. */
export function eventList(study, events, go) {
  if (!events.length) return null;
  const time = (value) => `${fixed(value, 2)}${unitAfter(study.unit("t"))}`;
  return element(
    "section",
    { class: "events", "data-testid": "events" },
    element("h3", {}, "Events"),
    element(
      "ol",
      {},
      events.map((event, index) =>
        element(
          "li",
          {},
          element(
            "button",
            {
              type: "button",
              class: `event ${event.kind}`,
              "data-testid": `event-${index}`,
              title: "go to this time",
              onclick: () => go(event),
            },
            element("span", { class: "when" }, time(event.time)),
            element("span", {}, event.text),
          ),
        ),
      ),
    ),
    element("p", { class: "note" }, "Peaks are those of the rows of the run. Legs that an event names glow at its time."),
  );
}

/** Bars of the legs between their stops. */
export class StrokeBars {
  /** null for a study without limits of length. */
  static of(study) {
    const limits = study.machine.all_limits.legs.length;
    return limits.every((range) => range?.[0] > 0 && range[1] > 0) ? new StrokeBars(study, limits) : null;
  }

  constructor(study, limits) {
    this.limits = limits;
    this.say = shower(Math.max(...limits.map(([, most]) => most)));
    this.rows = LEGS.map((color, index) => {
      const bar = element("i", { class: "stroke" });
      const value = element("output", { class: "value", "data-testid": `stroke-${index + 1}` });
      const [least, most] = limits[index].map((bound) => number(bound));
      return {
        bar,
        value,
        node: element(
          "li",
          { title: `leg ${index + 1}: from ${least} to ${most}${unitAfter(study.unit("l1"))}` },
          element("span", { class: "leg-name", style: { "--leg": color } }, String(index + 1)),
          element("span", { class: "track stops" }, bar),
          value,
        ),
      };
    });
    this.node = element(
      "section",
      { class: "strokes", "aria-label": "Strokes between both stops" },
      element("h3", {}, "Strokes", unit(study.unit("l1")) && element("span", { class: "unit" }, unit(study.unit("l1")))),
      element("ol", {}, this.rows.map(({ node }) => node)),
    );
  }

  /** Lengths of the moment; the share is that of the way from the shorter to the longer stop. */
  show(lengths) {
    this.rows.forEach(({ bar, value }, index) => {
      const [least, most] = this.limits[index];
      const share = (lengths[index] - least) / (most - least);
      bar.style.width = `${100 * Math.min(Math.max(share || 0, 0), 1)}%`;
      bar.classList.toggle("beyond", share < 0 || share > 1);
      value.textContent = Number.isFinite(share)
        ? `${this.say(lengths[index])} · ${Math.round(100 * share)} %`
        : "–";
    });
  }
}

const LIMITS = {
  leg_short: "least length",
  leg_long: "greatest length",
  leg_speed: "leg speed",
  leg_force: "leg force",
  leg_acceleration: "leg acceleration",
  base_swing: "swing at the base",
  top_swing: "swing at the top",
  platform_pose: "range of the platform",
  platform_speed: "speed of the platform",
  platform_acceleration: "acceleration of the platform",
};

/** How much of each limit the run uses, as the command has found it. */
export function limitsUsed(study) {
  const most = new Map();
  for (const limit of study.simulate?.limits ?? [])
    if (limit.share !== null && !(most.get(limit.kind)?.share >= limit.share)) most.set(limit.kind, limit);
  if (!most.size) return null;
  return element(
    "section",
    { class: "glance", "data-testid": "limits-used" },
    element("h3", {}, "Used of each limit"),
    element(
      "dl",
      { class: "live-facts" },
      [...most].map(([kind, { share, leg, component }]) => [
        element("dt", {}, LIMITS[kind] ?? kind),
        element("dd", { class: share > 1 ? "beyond" : null }, `${number(100 * share, 3)} %, ${leg ? `leg ${leg}` : component}`),
      ]),
    ),
  );
}
