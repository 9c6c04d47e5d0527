// What `gough stability` found, put in order for reading: equal values of a pair of modes once, the least first.

/** What the loop does with a small deviation: "stays", "drifts" (nothing grows, but a velocity once given stays for ever) or
 *  "grows". */
export function verdictOf(stability) {
  if (stability.stable) return "stays";
  const fastest = Math.max(...(stability.eigenvalues ?? []).map((pair) => Math.hypot(...pair)), 0);
  const grows =
    stability.growth_per_period > 1 + 1e-7 || stability.growth_rate > 1e-6 * fastest;
  return stability.drifts?.length && !grows ? "drifts" : "grows";
}

/** Thresholds of G at rest, ascending, each value of a mode once: [{mode, stiffness}]. */
export function thresholdsOf(stability) {
  const sorted = [...(stability?.thresholds ?? [])].sort((a, b) => a.stiffness - b.stiffness);
  return sorted.filter(({ mode, stiffness }, index) => {
    const before = sorted
      .slice(0, index)
      .filter((other) => other.mode === mode)
      .pop();
    return !before || Math.abs(stiffness - before.stiffness) > 1e-9 * Math.abs(stiffness);
  });
}

/** The stiffness from which each mode holds: its greatest threshold, ascending. */
export function holdsFrom(stability) {
  const greatest = new Map();
  for (const { mode, stiffness } of thresholdsOf(stability)) greatest.set(mode, stiffness);
  return [...greatest]
    .map(([mode, stiffness]) => ({ mode, stiffness }))
    .filter(({ stiffness }) => stiffness > 0)
    .sort((a, b) => a.stiffness - b.stiffness);
}

/** Modes at rest: [{mode, rate, frequency}] from the eigenvalues with Im ≥ 0, the fastest growing first. */
export function modesAtRest(stability) {
  return (stability?.eigenvalues ?? [])
    .map(([rate, frequency], index) => ({
      rate,
      frequency,
      mode: stability.modes?.[index]?.name ?? "",
    }))
    .filter(({ frequency }) => frequency >= 0)
    .sort((a, b) => b.rate - a.rate);
}

/** Floquet multipliers by size: [{mode, size}], each pair of conjugates once. */
export function multipliersBySize(stability) {
  return (stability?.multipliers ?? [])
    .map(([re, im], index) => ({
      re,
      im,
      size: Math.hypot(re, im),
      mode: stability.multiplier_modes?.[index]?.name ?? "",
    }))
    .filter(({ im }) => im >= 0)
    .sort((a, b) => b.size - a.size);
}
