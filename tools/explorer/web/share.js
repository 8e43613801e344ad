// The patch as text to copy and files to save, as `tess` writes them.

import { element, link, state } from "./state.js";
import { patch } from "./patch.js";

// Texts that can be copied, each with its name.
const COPIES = [
  ["link", "Link to this view", () => link()],
  ["line", "Case line for tess check", () => patch.line],
  ["command", "Command", () => patch.view.command()],
  ["listing", "Listing of the whole patch", () => patch.view.listing()],
];

const drawn = () => (state.colours === "order" || state.colours === "rings" ? state.colours : "plain");
const numbered = () => state.numbers === "points" || state.numbers === "both";

// Files: extension, type, contents, and the command that writes the same.
const FILES = [
  ["svg", "image/svg+xml", () => patch.view.svg(drawn(), numbered(), 800)],
  ["png", "image/png", () => patch.view.png(drawn(), numbered(), 800)],
  ["obj", "model/obj", () => patch.view.obj()],
  ["csv", "text/csv", () => patch.view.csv()],
  ["txt", "text/plain", () => patch.view.text()],
];

export function start() {
  element("copies").append(...COPIES.map(makeCopy));
  element("downloads").append(...FILES.map(makeFile));
}

function makeCopy([id, name, text]) {
  const box = document.createElement("div");
  box.className = "copy";
  box.innerHTML = `<label>${name} <input type="text" readonly id="copy-${id}"></label><button>Copy</button>`;
  const [field, button] = [box.querySelector("input"), box.querySelector("button")];
  button.setAttribute("aria-label", `Copy: ${name}`);
  button.addEventListener("click", async () => {
    await copy(text(), field);
    button.textContent = "Copied";
    setTimeout(() => (button.textContent = "Copy"), 1200);
  });
  return box;
}

// Copies a text; where the browser refuses, selects it in the field.
export async function copy(text, field) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    if (!field) throw new Error("the browser does not let this page copy");
    field.value = text;
    field.select();
  }
}

function makeFile([extension, type, contents]) {
  const button = document.createElement("button");
  button.textContent = extension.toUpperCase();
  button.id = `save-${extension}`;
  button.addEventListener("click", () => {
    const anchor = document.createElement("a");
    anchor.href = URL.createObjectURL(new Blob([contents()], { type }));
    anchor.download = `patch.${extension}`;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 1000);
  });
  return button;
}

export function update() {
  if (state.answer !== "share") return;
  for (const [id, , text] of COPIES) {
    const field = element(`copy-${id}`);
    field.value = id === "link" ? location.href : text().split("\n")[0];
  }
}
