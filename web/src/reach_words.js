// Sentences about poses and reach. In a file of their own, without the page, so that they can be tested in Node.

/** What is said of poses whose determinant has the other sign. */
export const MIRRORED = "opposite sign: behind a singular pose";

/** Whether a pose has the determinant's sign at home. */
export const sameSide = (pose, known) => pose.determinant * (known?.side || 1) > 0;

const plural = (count, one, many) => `${count} ${count === 1 ? one : many}`;

/** How many poses there are, and whether these are all. */
export function countWords({ real, nonreal, infinite, singular, complete }) {
  const poses = real === 0 ? "No real pose was found." : `${plural(real, "real pose has", "real poses have")} these lengths.`;
  const rest = {
    proved: `There are no others: all 40 solutions are certified, and ${nonreal} of them are not real.`,
    counted:
      `Others are unlikely, but that is not proved: ${plural(nonreal, "solution is", "solutions are")} not real, ` +
      `and ${plural(infinite, "path", "paths")} of 40 ended at infinity.`,
    no: `There may be more: ${plural(singular, "path", "paths")} of 40 ended at a singular pose or were lost.`,
  }[complete];
  return `${poses} ${rest}`;
}

/** How the solid pose came about. */
export function wayWords({ because, followed }) {
  if (because === "take") return "The machine was put into this pose.";
  if (because === "place") return "The pose of home or of the run.";
  if (!followed.refused)
    return "The solid pose is joined to the last one: on the straight line of the squared lengths there is no singular pose.";
  return `The machine stopped after ${(100 * followed.part).toPrecision(3)} % of the way: ${followed.refused}.`;
}

const LEG_WORDS = {
  shortest: "least length",
  longest: "greatest length",
  base_swing: "swing at the base",
  top_swing: "swing at the top",
  speed: "greatest speed",
  acceleration: "greatest acceleration",
  push: "greatest force",
  pull: "least force",
};
const OTHER_WORDS = {
  pose: "the platform's limit",
  singular: "a singular pose",
  singular_value: "least singular value",
  none: "no limit found",
};

/** What ends a way: {text, leg}, leg being whether it is one leg's. */
export function endWords({ limit, which, other }) {
  if (limit === "clearance") return { text: `legs ${which + 1} and ${other + 1} touch`, leg: true };
  if (LEG_WORDS[limit]) return { text: `leg ${which + 1}: ${LEG_WORDS[limit]}`, leg: true };
  return { text: OTHER_WORDS[limit] ?? limit, leg: false };
}
