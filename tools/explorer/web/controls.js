// The controls of the patch: configuration, factors, links, animation, curiosities, the case line.

import { curiosities, factor_bits, factor_text, step_factor } from "./tess_explorer.js";
import { FIRST, domainOf, element, formatLine, known, set, state } from "./state.js";
import { load, patch } from "./patch.js";

const SPECIAL = ["0", "-0", "1", "2", "63", "64", "65", "0.5", "nan", "inf", "-inf", "0x00000001", "0x3f800001", "0x3f800040", "0x3f800041"];
const LARGEST = 66;

const floats = new Float32Array(1), words = new Uint32Array(floats.buffer);
const toValue = (bits) => ((words[0] = bits), floats[0]);
export const toBits = (value) => ((floats[0] = value), words[0]);

let rows = [];

export function start() {
  const options = (id, names) => element(id).replaceChildren(...names.map((name) => new Option(name, name)));
  options("domain", known.domains.map((domain) => domain.name));
  options("partitioning", known.partitionings.map((partitioning) => partitioning.name));
  options("surface-partitioning", known.partitionings.map((partitioning) => partitioning.name));
  options("output", known.outputs);
  options("split", known.splits);
  for (const key of ["partitioning", "output", "split"]) {
    element(key).addEventListener("change", () => change({ [key]: element(key).value }));
  }
  element("domain").addEventListener("change", () => changeDomain(element("domain").value));
  for (const key of ["link", "colours", "numbers"]) {
    element(key).addEventListener("change", () => set({ [key]: element(key).value }));
  }
  element("marks").addEventListener("change", () => set({ marks: element("marks").checked ? "1" : "" }));
  element("case").addEventListener("change", () => set({ line: element("case").value.trim() }));
  element("curiosities").addEventListener("focus", fillCuriosities, { once: true });
  element("curiosities").addEventListener("pointerdown", fillCuriosities, { once: true });
  element("curiosities").addEventListener("change", () => {
    if (element("curiosities").value) set({ line: element("curiosities").value, view: "", built: "" });
  });
  const built = element("built");
  built.addEventListener("input", () => set({ built: Number(built.value) >= patch.primitives ? "" : built.value }));
}

function fillCuriosities() {
  const select = element("curiosities");
  if (select.querySelector("optgroup")) return;
  for (const { name, cases } of JSON.parse(curiosities())) {
    const group = document.createElement("optgroup");
    group.label = `${name} (${cases.length})`;
    group.append(...cases.map((curiosity) => new Option(curiosity.name, curiosity.line)));
    select.append(group);
  }
}

// Changes parts of the case.
export function change(parts) {
  set({ line: formatLine({ ...patch.parts, ...parts }) });
}

// Another domain keeps as many factors as it has, and repeats the last one.
function changeDomain(domain) {
  const { factors } = patch.parts;
  const count = domainOf(domain).factors.length;
  const isLines = patch.parts.output !== "point" && domain === "isoline";
  const output = isLines ? "line" : domain !== "isoline" && patch.parts.output === "line" ? "triangle_cw" : patch.parts.output;
  const kept = Array.from({ length: count }, (_, k) => factors[Math.min(k, factors.length - 1)]);
  set({ line: formatLine({ ...patch.parts, domain, output, factors: kept }), view: "", built: "" });
}

// Sets one factor, and those that are linked to it.
export function changeFactor(number, bits) {
  change({ factors: linked(patch.parts, number, bits >>> 0, state.link) });
}

// As patches of a surface do: an inside factor follows the larger of the edges along its axis.
function linked({ domain, factors }, number, bits, link) {
  const { outer } = domainOf(domain);
  if (link === "all") return factors.map(() => bits);
  const next = factors.slice();
  next[number] = bits;
  if (link !== "edges" || number >= outer || domain === "isoline") return next;
  const larger = (a, b) => (toValue(a) > toValue(b) ? a : b);
  if (domain === "tri") return next.map(() => bits);
  next[(number + 2) % 4] = bits;
  next[4] = larger(next[1], next[3]);
  next[5] = larger(next[0], next[2]);
  return next;
}

export function update(keys) {
  for (const key of ["link", "colours", "numbers"]) element(key).value = state[key];
  element("marks").checked = state.marks !== "";
  element("marks-legend").hidden = state.marks === "";
  if (keys.has("line")) {
    load(state.line);
    if (!patch.view) load(FIRST, patch.error);
    element("case-error").textContent = patch.error;
    if (document.activeElement !== element("case") || !patch.error) element("case").value = patch.error ? state.line : patch.line;
    for (const key of ["domain", "partitioning", "output", "split"]) element(key).value = patch.parts[key];
    showFactors();
  }
  const built = element("built");
  built.max = patch.primitives;
  built.value = state.built === "" ? patch.primitives : state.built;
  element("built-text").textContent = `${built.value} of ${patch.primitives}`;
}

function showFactors() {
  const names = domainOf(patch.parts.domain).factors;
  if (rows.map((row) => row.name).join() !== names.join()) {
    rows = names.map(makeRow);
    element("factors").replaceChildren(...rows.map((row) => row.box));
    element("animate-factor").replaceChildren(new Option("all", "all"), ...names.map((name, k) => new Option(name, k)));
  }
  rows.forEach((row, k) => {
    const bits = patch.parts.factors[k], value = toValue(bits);
    if (document.activeElement !== row.text || row.bits !== bits) row.text.value = factor_text(bits);
    if (document.activeElement !== row.range || toValue(toBits(Number(row.range.value))) !== value) {
      row.range.value = Number.isFinite(value) ? value : value > 0 ? LARGEST : 0;
    }
    row.text.title = `0x${bits.toString(16).padStart(8, "0")}`;
    row.text.setCustomValidity("");
    row.bits = bits;
  });
}

function makeRow(name, number) {
  const box = document.createElement("div");
  box.className = "factor";
  const label = name.replace("_", " ");
  box.innerHTML = `<span class="name">${label}</span>
    <input type="range" min="0" max="${LARGEST}" step="0.01" aria-label="${label}, slider">
    <input type="text" spellcheck="false" autocomplete="off" aria-label="${label}" id="factor-${name}">
    <select aria-label="${label}, special values"><option value="">…</option></select>`;
  const [range, text] = box.querySelectorAll("input");
  const special = box.querySelector("select");
  special.append(...SPECIAL.map((value) => new Option(value, value)));
  range.addEventListener("input", () => changeFactor(number, toBits(Number(range.value))));
  text.addEventListener("change", () => enter(number, text));
  text.addEventListener("keydown", (event) => {
    if (event.key === "Enter") return enter(number, text);
    const steps = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!steps) return;
    event.preventDefault();
    changeFactor(number, step_factor(patch.parts.factors[number], steps));
  });
  special.addEventListener("change", () => {
    if (special.value) changeFactor(number, factor_bits(special.value));
    special.value = "";
  });
  return { name, box, range, text, bits: NaN };
}

function enter(number, text) {
  try {
    changeFactor(number, factor_bits(text.value));
    text.setCustomValidity("");
  } catch (error) {
    text.setCustomValidity(error.message);
    text.reportValidity();
  }
}

