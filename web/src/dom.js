// Elements by description. Text only ever becomes a text node, so a study's title cannot become markup.

const SVG = "http://www.w3.org/2000/svg";

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (name === "style")
      Object.entries(value).forEach(([key, setting]) => node.style.setProperty(key, setting));
    else node.setAttribute(name, value === true ? "" : String(value));
  }
  return fillWith(node, children);
}

/** Appends nodes and texts, from lists in lists; what is undefined, null or false is passed over. */
export function fillWith(node, children) {
  for (const child of children.flat(Infinity)) {
    if (child === undefined || child === null || child === false) continue;
    node.append(child);
  }
  return node;
}

/** An HTML element: attributes by name, listeners as onclick and so on, children as nodes or text. An output is read out when
 *  it is asked for, not whenever it changes: here they change with every picture. */
export const element = (tag, attributes = {}, ...children) =>
  fill(
    document.createElement(tag),
    tag === "output" ? { "aria-live": "off", ...attributes } : attributes,
    children,
  );

/** An SVG element. */
export const drawing = (tag, attributes = {}, ...children) =>
  fill(document.createElementNS(SVG, tag), attributes, children);

/** The element of index.html with this id. */
export const byId = (id) => document.getElementById(id);

/** A custom property of the theme in force, such as "--ink". */
export const themed = (property) =>
  getComputedStyle(document.documentElement).getPropertyValue(property).trim();

/** Whether the reader asked the system for less motion. */
export const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
