// Numbers and units as people read them. What is saved does not pass through here.

const MINUS = "\u2212";
const SUPERSCRIPT = {
  "-": "⁻",
  0: "⁰",
  1: "¹",
  2: "²",
  3: "³",
  4: "⁴",
  5: "⁵",
  6: "⁶",
  7: "⁷",
  8: "⁸",
  9: "⁹",
};
const raised = (power) => [...String(power)].map((digit) => SUPERSCRIPT[digit]).join("");

/** A number in a few significant digits: 0.2034, −12.5, 3.1·10⁻⁷; a dash where there is none. */
export function number(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : `${MINUS}∞`;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    const text = Number(value.toPrecision(digits)).toString();
    return text.replace("-", MINUS);
  }
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  return `${Number(mantissa).toString().replace("-", MINUS)}·10${raised(Number(power))}`;
}

/** A number that is known to within its noise: 0 where it is smaller, else no more digits than are known. */
export function known(value, noise, digits = 5) {
  if (!Number.isFinite(value) || !(noise > 0)) return number(value, digits);
  const size = Math.abs(value);
  if (size <= noise) return "0";
  return number(value, Math.max(1, Math.min(digits, Math.floor(Math.log10(size / noise)) + 1)));
}

/** A magnitude that is known to within its noise: where it is smaller, "below 2·10⁻⁹" in place of a number; `bound` leaves out
 *  the word, for a number behind "at most". */
export function below(value, noise, digits = 5, bound = false) {
  if (!Number.isFinite(value) || !(noise > 0) || Math.abs(value) > noise)
    return known(value, noise, digits);
  const unit = 10 ** Math.floor(Math.log10(noise));
  const most = number(Math.ceil((noise / unit) * (1 - 1e-12)) * unit, 1);
  return bound ? most : `below ${most}`;
}

/** A number with a fixed count of decimals, for what changes while it is read. */
export function fixed(value, decimals) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", MINUS);
}

/** How numbers of a quantity of this size are shown while they change: fixed decimals, about `digits` of them telling; powers of
 *  ten where the size is far from 1. */
export function shower(size, digits = 5) {
  if (!(size >= 1e-3 && size < 1e6)) return (value) => number(value, digits);
  const decimals = Math.max(0, Math.min(9, digits - 1 - Math.floor(Math.log10(size))));
  return (value) => fixed(value, decimals);
}

/** A unit of the tables as it is printed: "m/s2" gives "m/s²", "degree" gives "°"; "" for the bare number. */
export function unit(text) {
  if (!text || text === "1") return "";
  return text
    .replace("degree", "°")
    .replace(/([a-z])([2-9])/g, (_, letter, power) => letter + raised(power))
    .replace(" ", " ");
}

/** " N" after a number, "" for the bare number; with a space, lest a degree sign look like a power. */
export function unitAfter(text) {
  const word = unit(text);
  if (!word) return "";
  return ` ${word}`;
}

/** A number with its unit: "0.25 m/s". */
export const amount = (value, unitText, digits = 4) =>
  `${number(value, digits)}${unitAfter(unitText)}`;

/** Decimals that a step needs (0.025: three; 2000: −3), three digits at most. */
function decimalsOf(step) {
  const least = -Math.floor(Math.log10(step) + 1e-9);
  for (let decimals = least; decimals < least + 3; decimals++) {
    const whole = step * 10 ** decimals;
    if (Math.abs(whole - Math.round(whole)) <= 1e-6 * whole) return decimals;
  }
  return least + 2;
}

/** Tick labels of an axis: as many digits as tell neighbours apart, and the same number for all. */
export function ticks(values) {
  const present = values.filter((value) => value !== null);
  const largest = Math.max(...present.map(Math.abs), 0);
  if (largest === 0) return values.map((value) => (value === null ? "" : "0"));
  const step = present.length > 1 ? Math.abs(present[1] - present[0]) : largest;
  const decimals = decimalsOf(step || largest);
  const power = Math.floor(Math.log10(largest) + 1e-9);
  const digits = Math.max(0, Math.min(power + decimals, 15));
  const raises = power < -3 || power > 15 || (power > 5 && digits <= 3);
  return values.map((value) => {
    if (value === null) return "";
    if (Math.abs(value) < 0.01 * step) return "0";
    if (!raises) return fixed(value, Math.max(0, decimals));
    return `${fixed(value / 10 ** power, digits)}·10${raised(power)}`;
  });
}

/** Room in pixels for the labels of an ordinate, whose characters are at most so wide. */
export const labelRoom = (labels, least, wide = 6.7) =>
  Math.max(least, Math.ceil(14 + wide * Math.max(0, ...(labels ?? []).map((text) => text.length))));

/** Ticks of a logarithmic axis: powers of ten. */
export const powers = (values) =>
  values.map((value) =>
    value === null || Math.abs(Math.log10(value) % 1) > 1e-9
      ? ""
      : `10${raised(Math.round(Math.log10(value)))}`,
  );

/** Words for how a run ended, by gough_cause_name(). */
export function causeWords(status) {
  return (
    {
      done: "completed",
      leg_short: "a leg is shorter than its limit",
      leg_long: "a leg is longer than its limit",
      leg_speed: "a leg exceeds its greatest speed",
      leg_force: "a leg exceeds its greatest force",
      leg_no_length: "both joints of a leg coincided",
      singular: "singular pose",
      not_finite: "a number was no longer finite",
      no_convergence: "the steps did not converge",
      leg_acceleration: "the length of a leg accelerated too fast",
      base_swing: "a leg turned too far at the base",
      top_swing: "a leg turned too far at the top",
      platform_pose: "the platform left its range",
      platform_speed: "the platform moved too fast",
      platform_acceleration: "the platform accelerated too fast",
      stopped: "stopped",
    }[status] ?? status
  );
}
