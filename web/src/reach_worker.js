// Searches for poses and reach, in a thread of their own, so that the page never waits for them.
import { inflated } from "./core.js";
import { directions, ReachCore } from "./reach_core.js";

/** Rays of the surface that are followed before other orders are heard. */
const AT_ONCE = 48;

let core;
let known;

/** A turn for the orders that wait. */
const pause = () => new Promise((resolve) => setTimeout(resolve, 0));

/** All poses of lengths, and the present one. */
function answer(kind, length, followed = { part: 1, refused: "" }) {
  const found = core.poses(length);
  postMessage({ kind: "poses", because: kind, length, found, followed, present: core.pose(-1) });
}

const orders = {
  async begin({ module, flat, chosen }) {
    core = await ReachCore.load(await inflated(module));
    core.begin(flat, chosen);
    known = core.reach();
    postMessage({ kind: "ready", known });
  },
  place({ pose }) {
    answer("place", core.stand(pose));
  },
  follow({ length }) {
    answer("follow", length, core.follow(length));
  },
  take({ index, length }) {
    core.take(index);
    answer("take", length);
  },
  async travel() {
    for (let component = 0; component < 6 && !known.refused; component++) {
      postMessage({ kind: "travel", component, travel: core.travel(component) });
      await pause();
    }
  },
  async surface({ azimuths, rings }) {
    const start = [0, 0, 0, ...known.orientation];
    const rays = [];
    for (const direction of directions(azimuths, rings)) {
      rays.push(core.ray(start, [...direction, 0, 0, 0]));
      if (rays.length % AT_ONCE === 0) await pause();
    }
    postMessage({ kind: "surface", azimuths, rings, rays });
  },
};

// orders wait until the core is loaded; travel and surface let others pass
let loaded = Promise.resolve();
addEventListener("message", ({ data }) => {
  const begun = loaded.then(() => orders[data.kind](data));
  if (data.kind === "begin") loaded = begun;
  begun.catch((error) => postMessage({ kind: "failed", message: error.message }));
});
