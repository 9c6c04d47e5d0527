// What is shown, in the part of the address behind #: study, part of the page, time, view, range of time, what is switched off, and
// the settings of the live run. A page that is opened with such an address shows the same.
import { byId, element } from "./dom.js";

/** So long after the last change the address follows, in milliseconds: browsers refuse too many changes. */
const PAUSE = 300;

/** A number with no more digits than are seen. */
const short = (value) => String(Number(value.toPrecision(6)));

/** The finite numbers of a list such as "1,2", or null where they are not as many as wanted. */
function numbersOf(text, count) {
  const numbers = (text ?? "").split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  return numbers.length === count && numbers.every(Number.isFinite) ? numbers : null;
}

/** What a page shows, as "study=0&t=1.5&…"; what is as in the beginning is left out. */
export function stateOf(page) {
  const { live, mode, player, scene, section, switched } = page;
  const words = [`study=${page.chosen}`];
  const off = Object.keys(switched).filter((part) => !switched[part]);
  if (mode !== "recorded") words.push(`part=${mode}`);
  if (player.time > 0) words.push(`t=${Number(player.time.toPrecision(12))}`);
  words.push(`view=${scene.eye.view.map(short)}`);
  if (section.range?.zoomed) words.push(`range=${section.range.shown.map(short)}`);
  if (off.length) words.push(`off=${off}`);
  if (section.hiddenLegs?.length) words.push(`legs-off=${section.hiddenLegs}`);
  if (mode === "live") {
    for (const [name, { value }] of Object.entries(live.sliders))
      if (name in live.moved) words.push(`${name}=${short(value)}`);
    if ("feedforward" in live.moved) words.push(`feedforward=${Number(live.feedforward.checked)}`);
  }
  return words.join("&");
}

/** Sets the live run as the address says; what it does not name stays. */
function setLive(live, given) {
  for (const [name, slider] of Object.entries(live.sliders)) {
    const value = numbersOf(given.get(name), 1);
    if (value && value[0] >= 0) slider.take(value[0]);
  }
  const fed = numbersOf(given.get("feedforward"), 1);
  if (fed && live.feedforward.checked !== fed[0] > 0) live.feedforward.click();
}

/** Copies a text; where the browser refuses, by a selected field. */
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const field = element("textarea", { class: "unseen", "aria-hidden": "true" });
    field.value = text;
    document.body.append(field);
    field.select();
    const copied = document.execCommand("copy");
    field.remove();
    return copied;
  }
}

export class Link {
  constructor(page) {
    this.page = page;
    this.quiet = true;
  }

  bind() {
    const { page } = this;
    page.scene.controls.addEventListener("end", () => this.changed());
    page.scene.canvas.addEventListener("keyup", () => this.changed());
    byId("copy-link").addEventListener("click", () => this.copy());
    addEventListener("hashchange", () => this.apply());
    this.quiet = false;
    if (location.hash.length > 1) this.apply();
  }

  /** What is shown has changed: the address follows after a pause. */
  changed() {
    if (this.quiet) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.write(), PAUSE);
  }

  write() {
    clearTimeout(this.timer);
    this.written = `#${stateOf(this.page)}`;
    // an address that only differs behind # is no other page, on disk too
    history.replaceState(null, "", this.written);
  }

  async copy() {
    this.write();
    const copied = await copy(location.href);
    const words = copied ? "The link is copied." : "The browser does not let this page copy; the link is in its address bar.";
    byId("link-said").textContent = words;
    clearTimeout(this.silence);
    this.silence = setTimeout(() => (byId("link-said").textContent = ""), 4000);
  }

  /** Shows what the address says. Words that are no state of this page change nothing. */
  apply() {
    const { page } = this;
    if (location.hash === this.written) return;
    const given = (this.given = new URLSearchParams(location.hash.slice(1)));
    const study = given.get("study");
    if (study === "all" && page.studies.length > 1) page.choose("all");
    else if (/^\d+$/.test(study ?? "") && page.studies[Number(study)]) page.choose(Number(study));
    const off = (given.get("off") ?? "").split(",");
    for (const part of Object.keys(page.switched))
      if (page.switched[part] === off.includes(part)) page.switchPart(part);
    if (given.has("t") || given.has("part")) page.player.pause();
    const time = numbersOf(given.get("t"), 1);
    if (time) page.player.seek(time[0]);
    if (given.has("part")) page.setMode(given.get("part"));
    if (page.mode === "live") setLive(page.live, given);
    const view = numbersOf(given.get("view"), 6);
    if (view && view[2] > 0) page.scene.eye.take(view);
    if (page.section.range) this.applyCurves();
  }

  /** The same for the curves, which are made after the machine. */
  applyCurves() {
    const { given } = this;
    const { section } = this.page;
    if (!given || !section.range) return;
    this.given = null;
    const range = numbersOf(given.get("range"), 2);
    if (range && range[1] > range[0]) section.range.set(...range);
    const hidden = (given.get("legs-off") ?? "").split(",").map(Number);
    if (this.page.alone) section.hideLegs(hidden);
  }
}
