// State of the page, as one object that the address holds.

import { choices } from "./tess_explorer.js";

export const FIRST = "case quad fractional_odd triangle_cw ruler 40a00000 40400000 40e00000 40900000 40c00000 40a00000";

// Every key of the address with its default.
const DEFAULTS = {
  line: FIRST, tab: "patch", answer: "learn", theme: "", link: "none",
  colours: "order", numbers: "none", marks: "", built: "", pick: "", view: "",
  against: "none", fault: "none", device: "",
  surface: "teapot", spacing: "fractional_odd", rule: "uniform", factor: "5", wire: "1", eye: "", kept: "", by: "gpu",
};

// Two lists of tabs: the views of the page, and the answers about the patch.
export const TABS = { tab: ["patch", "surface", "measure"], answer: ["ask", "compare", "share", "learn"] };

// The lists that the other keys are chosen from; keys that are not here have any text.
const LISTS = {
  link: "link", colours: "colours", numbers: "numbers", against: "against", fault: "fault", surface: "surface",
  rule: "rule", by: "surface-by",
};

// Whether a key can have a value. An address may be of another version, or mistyped.
function isPossible(key, value) {
  if (key in TABS) return TABS[key].includes(value);
  if (key in LISTS) return [...element(LISTS[key]).options].some((option) => option.value === value);
  if (key === "theme") return ["", "light", "dark"].includes(value);
  if (key === "spacing") return known.partitionings.some(({ name }) => name === value);
  if (key === "factor") return value.trim() !== "" && Number.isFinite(Number(value));
  if (key === "built") return /^\d*$/.test(value);
  if (key === "pick") return /^([pt]\d+)?$/.test(value);
  return true;
}

export const state = { ...DEFAULTS };
export let known = null;

const listeners = [];
let scheduled = false;
let remembered = 0;

// Calls `listener` with the keys that changed, once a frame at most.
export function onChange(listener) {
  listeners.push(listener);
}

let changed = new Set();

export function set(values) {
  for (const [key, value] of Object.entries(values)) {
    if (state[key] !== value) {
      state[key] = value;
      changed.add(key);
    }
  }
  if (changed.size > 0 && !scheduled) {
    scheduled = true;
    requestAnimationFrame(flush);
  }
}

export function flush() {
  scheduled = false;
  const keys = changed;
  changed = new Set();
  if (keys.size === 0) return;
  for (const listener of listeners) listener(keys);
  // Browsers refuse an address that changes too often.
  clearTimeout(remembered);
  remembered = setTimeout(remember, 150);
}

function remember() {
  const words = new URLSearchParams();
  for (const [key, value] of Object.entries(state)) {
    if (value !== DEFAULTS[key] || key === "line") words.set(key, value);
  }
  history.replaceState(null, "", `#${words}`);
}

// The address that shows what is shown now.
export function link() {
  remember();
  return location.href;
}

// Takes the state from the part of an address that begins with `#`.
function read(fragment) {
  const words = new URLSearchParams(fragment.slice(1));
  const values = { ...DEFAULTS };
  for (const key of Object.keys(DEFAULTS)) {
    if (words.has(key) && isPossible(key, words.get(key))) values[key] = words.get(key);
  }
  set(values);
}

export function start() {
  known = JSON.parse(choices());
  // The event's own address: the page may have remembered its state in between.
  addEventListener("hashchange", ({ newURL }) => read(new URL(newURL).hash));
  read(location.hash);
}

// Calls every listener now, as if everything had changed.
export function showAll() {
  Object.keys(DEFAULTS).forEach((key) => changed.add(key));
  flush();
}

export function domainOf(name) {
  return known.domains.find((domain) => domain.name === name);
}

// The parts of a case line: `case DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...`.
export function parseLine(line) {
  const [, domain, partitioning, output, split, ...factors] = line.trim().split(/\s+/);
  return { domain, partitioning, output, split, factors: factors.map((word) => parseInt(word, 16) >>> 0) };
}

export function formatLine({ domain, partitioning, output, split, factors }) {
  const words = factors.map((bits) => bits.toString(16).padStart(8, "0"));
  return ["case", domain, partitioning, output, split, ...words].join(" ");
}

// A number with what it counts: `1 point`, `2 points`.
export const counted = (number, one, many = `${one}s`) => `${number} ${number === 1 ? one : many}`;

export const element = (id) => document.getElementById(id);
