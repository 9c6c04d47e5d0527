// The page on paper: before it is printed, each curve gets a drawing by vectors in the place of its canvas, the machine is drawn by
// lines, and the margins get the title, the version and the numbers of the pages. After that all of it is taken away again.
import { riseOf } from "./arrange.js";
import { byId, drawing, element, fillWith } from "./dom.js";
import { groundNodes, machinesDrawn, triad } from "./drawing.js";
import { fixed } from "./format.js";

/** Size of the drawing of machines, in its own units; of one and of several. */
const SHEETS = { one: [400, 330], several: [700, 250] };

/** A text in a style sheet: all but plain letters, digits and spaces as their numbers. */
const quoted = (text) =>
  `"${[...text].map((sign) => (/[\w .,:;()-]/.test(sign) ? sign : `\\${sign.codePointAt(0).toString(16)} `)).join("")}"`;

/** A text with no more signs than this. */
const short = (text, most) => ([...text].length > most ? `${[...text].slice(0, most - 1).join("")}…` : text);

/** The margins: title and version above, the page's number below. */
const margins = (title, version) => `@page {
  margin: 19mm 14mm 17mm;
  @top-left { content: ${quoted(short(title, 80))}; font: 8pt system-ui, sans-serif; color: #333; }
  @top-right { content: ${quoted(`gough ${version}`)}; font: 8pt system-ui, sans-serif; color: #333; }
  @bottom-right { content: "page " counter(page) " of " counter(pages); font: 8pt system-ui, sans-serif; color: #333; }
}`;

/** The name of each machine under it. */
function machineNames(entries, { places }, projection) {
  return entries.map(({ machine, name }, index) => {
    const { shift, scale } = places[index];
    const joints = machine.base
      .map((joint) => projection.place(joint.map((part, axis) => shift[axis] + scale * part)))
      .filter(Boolean);
    const place = projection.place(shift);
    const y = Math.max(...joints.map((joint) => joint[1])) + 28;
    return place && drawing("text", { x: place[0], y, "text-anchor": "middle" }, short(name, 26));
  });
}

/** The machines at the moment of the slider, as a drawing with a caption. */
function machineFigure(page) {
  const { entries, player, scene, switched, transport, mode } = page;
  const [width, height] = SHEETS[entries.length > 1 ? "several" : "one"];
  const moments = page.momentsAt(player.time);
  const { room } = scene;
  const projection = scene.eye.wholeView(width, height, riseOf(entries, room, moments));
  const { size, low, places } = room;
  const names = entries.length > 1 ? machineNames(entries, room, projection) : [];
  const sheet = fillWith(drawing("svg", { class: "drawn printed", viewBox: `0 0 ${width} ${height}`, role: "img" }), [
    groundNodes(projection, { size, low, count: places.length }),
    machinesDrawn(projection, room, entries.map((entry) => ({ entry, poses: [] })), moments, switched),
    names,
    triad(projection, [34, height - 30], 22),
  ]);
  const time = `t = ${fixed(player.time, transport.decimals)}${transport.unit}`;
  const parts = [
    `The machine${entries.length > 1 ? "s" : ""} at ${time}.`,
    page.legendWords(),
    switched.ghost && moments.some(({ plan }) => plan) && "Dashed: the pose of the program.",
    switched.paths && "Lines: the path of the centre of mass up to this time, and that of the program (dotted).",
    mode !== "recorded" && "The recorded run is printed; the live run and the part Reach are not.",
  ];
  return element(
    "figure",
    { class: "print-machine", "data-testid": "print-machine" },
    sheet,
    element("figcaption", {}, parts.filter(Boolean).join(" ")),
  );
}

class Paper {
  constructor(page) {
    this.page = page;
    this.margins = element("style");
  }

  /** Makes the printed page of what is shown. Twice in a row is once. */
  lay() {
    if (this.laid) return;
    this.laid = true;
    const { page } = this;
    this.margins.textContent = margins(byId("title").textContent, page.version);
    document.head.append(this.margins);
    page.section.curves.forEach((curve) => curve.print());
    this.machine = machineFigure(page);
    byId("view").append(this.machine);
    this.opened = [...document.querySelectorAll("#numbers details:not([open])")];
    this.opened.forEach((part) => (part.open = true));
  }

  take() {
    if (!this.laid) return;
    this.laid = false;
    this.margins.remove();
    this.page.section.curves.forEach((curve) => curve.unprint());
    this.machine.remove();
    this.opened.forEach((part) => (part.open = false));
  }
}

/** Makes the page ready for paper whenever it is printed. */
export function bindPrint(page) {
  const paper = new Paper(page);
  addEventListener("beforeprint", () => paper.lay());
  addEventListener("afterprint", () => paper.take());
}
