// Keys: what the mouse does, without one.
import { byId, element } from "./dom.js";

/** Calls an action for its key, but not where the key has a meaning of its own. */
function listen(actions) {
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
    const action = actions.find(({ keys }) => keys.includes(event.key));
    if (!action) return;
    event.preventDefault();
    action.run(event);
  });
}

/** The keys that change between the recorded run and another part. */
const parts = (page) =>
  [
    ["l", "live", "live or recorded"],
    ["w", "reach", "reach: all poses of six leg lengths, and where the machine can go"],
  ].map(([key, mode, does]) => ({
    keys: [key],
    say: key,
    does,
    run: () => page.alone && page.setMode(page.mode === mode ? "recorded" : mode),
  }));

/** What each key does on a page. */
function actionsOn(page) {
  const recorded = (action) => (event) => page.mode === "recorded" && action(event);
  return [
    {
      keys: [" "],
      say: "space",
      does: "play or pause",
      run: () => {
        if (page.mode === "live") page.live.toggle();
        else if (page.mode === "recorded") page.player.toggle();
      },
    },
    {
      keys: ["ArrowRight"],
      say: "→",
      does: "a row on (with shift: ten)",
      run: recorded((event) => page.player.stepRows(event.shiftKey ? 10 : 1)),
    },
    {
      keys: ["ArrowLeft"],
      say: "←",
      does: "a row back (with shift: ten)",
      run: recorded((event) => page.player.stepRows(event.shiftKey ? -10 : -1)),
    },
    {
      keys: ["Home"],
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
      say: "end",
      does: "to the end",
      run: recorded(() => page.player.seek(page.player.duration)),
    },
    { keys: ["]", "+"], say: "]", does: "faster", run: recorded(() => page.transport.faster(1)) },
    {
      keys: ["[", "-"],
      say: "[",
      does: "slower",
      run: recorded(() => page.transport.faster(-1)),
    },
    { keys: ["r"], say: "r", does: "reset the view", run: () => page.scene?.resetView() },
    { keys: ["g"], say: "g", does: "the program's ghost", run: () => page.switchPart("ghost") },
    { keys: ["p"], say: "p", does: "the path", run: () => page.switchPart("paths") },
    ...parts(page),
    { keys: ["?"], say: "?", does: "these keys", run: () => byId("keys").showModal() },
  ];
}

/** Binds the keys to a page, and writes the help that lists them. */
export function bindKeys(page) {
  const actions = actionsOn(page);
  byId("keys").replaceChildren(
    element("h2", {}, "Keys"),
    element(
      "dl",
      {},
      actions.map(({ say, does }) => [
        element("dt", {}, element("kbd", {}, say)),
        element("dd", {}, does),
      ]),
    ),
    element(
      "p",
      { class: "note" },
      "Mouse: drag to turn, wheel to zoom, right button to shift. In a curve: point to see that moment, ",
      "drag to zoom, double-click for the full range. Live: grab the load and pull.",
    ),
    element("form", { method: "dialog" }, element("button", { class: "mini" }, "close")),
  );
  byId("keys-open").addEventListener("click", () => byId("keys").showModal());
  listen(actions);
}
