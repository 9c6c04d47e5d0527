// Presets of the live run's gains.
import { element } from "./dom.js";
import { holdsFrom } from "./stability.js";

/** Buttons that set stiffness and damping: none, below and above all thresholds at rest, and as in the study. */
export function presets(study, sliders) {
  const { stiffness, damping } = study.control;
  const [own, damped] = [Math.max(...stiffness), Math.max(...damping)];
  const most = Math.max(0, ...holdsFrom(study.stability).map((threshold) => threshold.stiffness));
  const settings = [
    ["open loop", 0, 0, "G = 0 and D = 0"],
    most > 0 && ["small G", most / 2, damped, "half of the greatest threshold at rest"],
    most > 0 && ["large G", 4 * most, damped, "four times the greatest threshold at rest"],
    ["the study's", own, damped, "G and D of the study"],
  ];
  return settings.filter(Boolean).map(([word, G, D, title]) => {
    const set = () => {
      sliders.stiffness.take(G);
      sliders.damping.take(D);
    };
    return element("button", { class: "mini", type: "button", title, onclick: set }, word);
  });
}
