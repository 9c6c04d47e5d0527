// Recording a live run: a row for each picture, saved as a table with the columns and units of the command's.
import { csv } from "./csv.js";
import { element } from "./dom.js";
import { download, fileName } from "./save.js";

/** Rows that are kept: about half an hour at sixty pictures a second. */
const MOST = 100000;

/** What a column counts in; angles of the core are radians. */
const KINDS = [
  [/^t$/, (study) => study.factor("time")],
  [/^(x|y|z|ex|ey|ez|l\d)$/, (study) => study.factor("length")],
  [/^(roll|pitch|yaw|eroll|epitch|eyaw)$/, (study) => study.factor("angle")],
  [/^(v[xyz]|dl\d)$/, (study) => study.factor("speed")],
  [/^w[xyz]$/, (study) => study.factor("angular_speed")],
  [/^a[xyz]$/, (study) => study.factor("acceleration")],
  [/^al[xyz]$/, (study) => study.factor("angular_speed") / study.factor("time")],
  [/^[fh]\d$/, (study) => study.factor("force")],
  [/^p\d$/, (study) => study.factor("power")],
  [/^(condition|drift)$/, () => 1],
];

/** The columns of the table: those of the core whose unit is known. */
const columnsOf = (study, place) =>
  Object.entries(place).flatMap(([name, at]) => {
    const kind = KINDS.find(([pattern]) => pattern.test(name));
    return kind ? [{ name, at, factor: kind[1](study) }] : [];
  });

export class LiveRecord {
  constructor(study) {
    this.study = study;
    this.rows = [];
    this.button = element(
      "button",
      {
        class: "mini",
        type: "button",
        "aria-pressed": "false",
        "data-testid": "live-record",
        title: "keep a row for each picture, and save them as CSV when it is switched off",
        onclick: () => this.toggle(),
      },
      "record",
    );
  }

  toggle() {
    const on = this.button.getAttribute("aria-pressed") !== "true";
    this.button.setAttribute("aria-pressed", String(on));
    if (on) this.rows = [];
    else this.save();
  }

  /** Takes a row of the core; a run that begins anew begins a new table. */
  take(place, row) {
    if (this.button.getAttribute("aria-pressed") !== "true" || !place) return;
    const last = this.rows[this.rows.length - 1];
    if (last && row[place.t] < last[place.t]) this.rows = [];
    // a picture while the run pauses has no new row
    else if (last && row[place.t] === last[place.t]) return;
    this.place = place;
    this.rows.push(row);
    this.button.textContent = `record (${this.rows.length})`;
    if (this.rows.length >= MOST) this.toggle();
  }

  save() {
    this.button.textContent = "record";
    if (!this.rows.length) return;
    const columns = columnsOf(this.study, this.place)
      .map(({ name, at, factor }) => ({ name, values: this.rows.map((row) => factor * row[at]) }))
      .filter(({ values }) => values.some((value) => Number.isFinite(value)));
    download(csv(columns), `${fileName(this.study.label)}-live.csv`, "text/csv");
  }
}
