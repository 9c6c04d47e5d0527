// Play, pause, scrub, speed: the bar under the scene.
import { element } from "./dom.js";
import { fixed, unitAfter } from "./format.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];

/** The slider of time, in rows of the table; moving it pauses the player. */
function timeSlider(player, rows) {
  const slider = element("input", {
    type: "range",
    min: "0",
    max: String(rows),
    step: "1",
    value: "0",
    "data-testid": "scrub",
    "aria-label": "time",
  });
  slider.addEventListener("input", () => {
    player.pause();
    player.seek(Number(slider.value) * player.step);
  });
  return slider;
}

/** A mark on the bar at the time of each end. */
const endMarks = (ends, duration) =>
  ends.map(({ time, label }) =>
    element("i", {
      class: "end-mark",
      title: label,
      style: { left: `${(100 * time) / duration}%` },
    }),
  );

/** A mark on the bar at the time of each event. */
const eventMarks = (events, duration) =>
  events.map(({ time, kind, text }) =>
    element("i", {
      class: `event-mark ${kind}`,
      title: text,
      style: { left: `${(100 * time) / (duration || 1)}%` },
    }),
  );

/** The list of speeds. */
function speedList(player) {
  const list = element(
    "select",
    { "aria-label": "speed", title: "speed", "data-testid": "speed" },
    SPEEDS.map((value) => element("option", { value, selected: value === 1 }, `${value}×`)),
  );
  list.addEventListener("change", () => (player.speed = Number(list.value)));
  return list;
}

/** The button that makes the player start again at the end, or stop there. */
function loopButton(player) {
  const button = element(
    "button",
    { class: "mini", type: "button", "aria-pressed": "true", title: "begin again at the end" },
    "loop",
  );
  button.addEventListener("click", () => {
    player.loop = !player.loop;
    button.setAttribute("aria-pressed", String(player.loop));
  });
  return button;
}

let watched;

/** Keeps the bar at the lower edge of the window while the view of the machine is out of sight. */
function float(host) {
  watched?.disconnect();
  watched = new IntersectionObserver(([{ isIntersecting }]) =>
    host.classList.toggle("afloat", !isIntersecting),
  );
  watched.observe(document.getElementById("view"));
}

export class Transport {
  /** @param host element; @param player the clock; @param unitText of time; @param ends [{time, label}] and
   *  @param events marked on the bar. */
  constructor(host, player, unitText, ends, events) {
    this.player = player;
    this.rows = Math.max(1, Math.round(player.duration / player.step));
    this.decimals = Math.max(2, Math.min(9, Math.ceil(-Math.log10(player.step))));
    this.unit = unitAfter(unitText);
    this.button = element("button", {
      class: "play",
      type: "button",
      "data-testid": "play",
      onclick: () => player.toggle(),
    });
    this.scrub = timeSlider(player, this.rows);
    this.label = element("output", { class: "span", "data-testid": "time" });
    this.speed = speedList(player);
    host.replaceChildren(
      this.button,
      element(
        "div",
        { class: "scrubber" },
        this.scrub,
        element(
          "div",
          { class: "marks", "aria-hidden": "true" },
          endMarks(ends, player.duration),
          eventMarks(events, player.duration),
        ),
      ),
      this.label,
      this.speed,
      loopButton(player),
    );
    player.listen(() => this.show());
    float(host);
  }

  show() {
    const { player } = this;
    const name = player.playing ? "pause" : "play";
    if (this.button.dataset.state !== name) {
      this.button.dataset.state = name;
      this.button.setAttribute("aria-label", name);
      this.button.title = `${name} (space)`;
    }
    this.scrub.value = String(Math.round(player.time / player.step));
    this.scrub.style.setProperty("--done", `${(100 * player.time) / (player.duration || 1)}%`);
    this.scrub.setAttribute(
      "aria-valuetext",
      `t = ${fixed(player.time, this.decimals)}${this.unit}`,
    );
    this.label.textContent = `${fixed(player.time, this.decimals)} / ${fixed(player.duration, this.decimals)}${this.unit}`;
  }

  faster(direction) {
    const index = Math.min(Math.max(this.speed.selectedIndex + direction, 0), SPEEDS.length - 1);
    this.speed.selectedIndex = index;
    this.player.speed = SPEEDS[index];
  }
}
