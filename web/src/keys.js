// Keys: what the mouse does, without one.
import { byId, element } from "./dom.js";

/** Where the focus is: in the view of the machine, elsewhere in the stage around it, or elsewhere on the page. */
const placeOf = (page, target) =>
  target === page.scene.canvas ? "view" : target.closest?.("#stage") ? "stage" : "page";

/** Calls an action for its key, but not where the key has a meaning of its own. */
function listen(page, actions) {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (document.querySelector("dialog[open]")) return;
    const { target } = event;
    if (/^(Arrow|Home|End)/.test(event.key) && target.closest?.(".scroll, pre")) return;
    const tag = target.tagName;
    if (
      tag === "TEXTAREA" ||
      tag === "SELECT" ||
      (tag === "INPUT" && target.type !== "range" && target.type !== "checkbox")
    )
      return;
    const range = tag === "INPUT" && target.type === "range";
    if (range && event.key !== " " && target.dataset.testid !== "scrub") return;
    if (event.key === " " && (tag === "BUTTON" || tag === "SUMMARY" || target.type === "checkbox"))
      return;
    if (target.getAttribute?.("role") === "tab" && event.key.startsWith("Arrow")) return;
    const place = placeOf(page, target);
    const action = actions.find(({ keys, where }) => keys.includes(event.key) && where.includes(place));
    if (!action) return;
    event.preventDefault();
    action.run(event);
  });
}

/** Places of the focus in which a key works: anywhere, in the stage with its view, anywhere but in the view, in the view. */
const ANYWHERE = ["view", "stage", "page"];
const STAGE = ["view", "stage"];
const ASIDE = ["stage", "page"];
const VIEW = ["view"];

/** Degrees that a key turns the view by, and the factor that one changes the distance by. */
const TURN = 5;
const CLOSER = 1.15;

/** Keys that turn the view. */
function viewActions(page) {
  const { eye } = page.scene;
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const names = ["front", "right", "back", "top", "first"];
  return [
    {
      keys: Object.keys(arrows),
      where: VIEW,
      say: "← → ↑ ↓",
      does: `turn by ${TURN}° (with shift: by 45°)`,
      run: ({ key, shiftKey }) => eye.turn(...arrows[key].map((way) => way * (shiftKey ? 45 : TURN))),
    },
    { keys: ["+", "="], where: VIEW, say: "+", does: "closer", run: () => eye.turn(0, 0, 1 / CLOSER) },
    { keys: ["-"], where: VIEW, say: "−", does: "farther", run: () => eye.turn(0, 0, CLOSER) },
    {
      keys: ["1", "2", "3", "4", "5"],
      where: STAGE,
      say: "1 … 5",
      does: "from the front (along y), the right (against x), the back, the top; the first view",
      run: ({ key }) => eye.look(names[Number(key) - 1]),
    },
  ];
}

/** The keys that change between the recorded run and another part. */
const parts = (page) =>
  [
    ["l", "live", "live or recorded"],
    ["w", "reach", "reach: all poses of six leg lengths, and where the machine can go"],
  ].map(([key, mode, does]) => ({
    keys: [key],
    where: STAGE,
    say: key,
    does,
    run: () => page.alone && page.setMode(page.mode === mode ? "recorded" : mode),
  }));

/** Keys that move the time. */
function timeActions(page) {
  const recorded = (action) => (event) => page.mode === "recorded" && action(event);
  const step = (way) => recorded((event) => page.player.stepRows(way * (event.shiftKey ? 10 : 1)));
  return [
    {
      keys: [" "],
      where: ANYWHERE,
      say: "space",
      does: "play or pause",
      run: () => {
        if (page.mode === "live") page.live.toggle();
        else if (page.mode === "recorded") page.player.toggle();
      },
    },
    { keys: ["ArrowRight"], where: ASIDE, say: "→", does: "a row on (with shift: ten)", run: step(1) },
    { keys: ["ArrowLeft"], where: ASIDE, say: "←", does: "a row back (with shift: ten)", run: step(-1) },
    {
      keys: ["Home"],
      where: STAGE,
      say: "home",
      does: "to the start; live: start again; reach: home",
      run: () => {
        if (page.mode === "live") page.live.restart();
        else if (page.mode === "reach") page.reach.toHome();
        else page.player.seek(0);
      },
    },
    {
      keys: ["End"],
      where: STAGE,
      say: "end",
      does: "to the end",
      run: recorded(() => page.player.seek(page.player.duration)),
    },
    { keys: ["]"], where: STAGE, say: "]", does: "faster", run: recorded(() => page.transport.faster(1)) },
    { keys: ["["], where: STAGE, say: "[", does: "slower", run: recorded(() => page.transport.faster(-1)) },
  ];
}

/** What each key does on a page. */
function actionsOn(page) {
  return [
    ...timeActions(page),
    ...viewActions(page),
    { keys: ["r"], where: STAGE, say: "r", does: "reset the view", run: () => page.scene.resetView() },
    { keys: ["g"], where: STAGE, say: "g", does: "the program's ghost", run: () => page.switchPart("ghost") },
    { keys: ["p"], where: STAGE, say: "p", does: "the path", run: () => page.switchPart("paths") },
    ...parts(page),
    { keys: ["?"], where: STAGE, say: "?", does: "these keys", run: () => byId("keys").showModal() },
  ];
}

/** A list of keys and what they do. */
const keyList = (actions) =>
  element(
    "dl",
    {},
    actions.map(({ say, does }) => [
      element("dt", {}, element("kbd", {}, say)),
      element("dd", {}, does),
    ]),
  );

/** Binds the keys to a page, and writes the help that lists them. */
export function bindKeys(page) {
  const actions = actionsOn(page);
  byId("keys").replaceChildren(
    element("h2", {}, "Keys"),
    element("h3", {}, "Everywhere, but not in the view of the machine"),
    keyList(actions.filter(({ where }) => where.includes("page"))),
    element("h3", {}, "While the machine or a control beside it has the focus"),
    keyList(actions.filter(({ where }) => where === STAGE)),
    element("h3", {}, "While the view of the machine has the focus"),
    keyList(actions.filter(({ where }) => where === VIEW)),
    element(
      "p",
      { class: "note" },
      "Mouse: drag to turn, wheel to zoom, right button to shift. Touch: two fingers turn and zoom. ",
      "In a curve: point to see the numbers of a moment, click to go there, ",
      "drag to zoom, double-click for the full range. Live: grab the load and pull.",
    ),
    element("form", { method: "dialog" }, element("button", { class: "mini" }, "close")),
  );
  byId("keys-open").addEventListener("click", () => byId("keys").showModal());
  listen(page, actions);
}
