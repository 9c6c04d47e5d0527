// Sliders with a number beside them, linear or by powers of ten with a zero at the left end.
import { element } from "./dom.js";
import { number } from "./format.js";

const STEPS = 1000;
/** Share of a logarithmic slider that is zero. */
const ZERO = 0.04;

export class Slider {
  /** @param spec {family, id, label, unit, least, greatest, logarithmic, value, digits, help, marks: [{value, label}]};
   *  @param onChange(value). */
  constructor(spec, onChange) {
    this.spec = spec;
    this.onChange = onChange;
    this.range = element("input", {
      type: "range",
      min: 0,
      max: STEPS,
      step: 1,
      id: `${spec.family ?? "live"}-${spec.id}`,
      "data-testid": `${spec.family ?? "live"}-${spec.id}`,
      "aria-describedby": spec.help ? `help-${spec.id}` : undefined,
    });
    this.box = element("input", {
      type: "text",
      inputmode: "decimal",
      size: 7,
      "aria-label": `${spec.label}, as a number`,
      "data-testid": `${spec.family ?? "live"}-${spec.id}-number`,
      autocomplete: "off",
    });
    this.range.addEventListener("input", () =>
      this.take(this.valueAt(Number(this.range.value) / STEPS)),
    );
    this.box.addEventListener("change", () => {
      const typed = Number(this.box.value.replace(",", ".").replace("−", "-"));
      this.take(
        this.box.value.trim() !== "" && Number.isFinite(typed) ? Math.max(typed, 0) : this.value,
      );
    });
    this.marks = element("div", { class: "slider-marks", "aria-hidden": "true" });
    this.node = element(
      "div",
      { class: "slider" },
      element(
        "label",
        { for: `${spec.family ?? "live"}-${spec.id}` },
        spec.label,
        spec.unit && element("span", { class: "unit" }, spec.unit),
      ),
      this.box,
      element("div", { class: "rail" }, this.range, this.marks),
      spec.help && element("p", { class: "help", id: `help-${spec.id}` }, spec.help),
    );
    this.showMarks(spec.marks ?? []);
    this.set(spec.value);
  }

  valueAt(share) {
    const { least, greatest, logarithmic } = this.spec;
    if (!logarithmic) return least + share * (greatest - least);
    if (share < ZERO / 2) return 0;
    return Number(
      (least * (greatest / least) ** Math.max(0, (share - ZERO) / (1 - ZERO))).toPrecision(4),
    );
  }

  shareOf(value) {
    const { least, greatest, logarithmic } = this.spec;
    if (!logarithmic) return (value - least) / (greatest - least);
    if (value < least * 0.999) return 0;
    return ZERO + (1 - ZERO) * (Math.log(value / least) / Math.log(greatest / least));
  }

  /** Marks on the rail, such as thresholds. */
  showMarks(marks) {
    this.marks.replaceChildren(
      ...marks.map(({ value, label }) =>
        element("i", {
          title: label,
          style: { left: `${100 * Math.min(Math.max(this.shareOf(value), 0), 1)}%` },
        }),
      ),
    );
  }

  set(value) {
    this.value = value;
    this.range.value = String(Math.round(STEPS * Math.min(Math.max(this.shareOf(value), 0), 1)));
    this.range.style.setProperty("--done", `${Number(this.range.value) / 10}%`);
    this.range.setAttribute("aria-valuetext", number(value, this.spec.digits ?? 4));
    this.box.value = String(Number(value.toPrecision(this.spec.digits ?? 4)));
  }

  take(value) {
    this.set(value);
    this.onChange(value);
  }
}
