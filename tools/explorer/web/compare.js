// Other results against the model's: split orders, partitionings, a device's listing, both backends.

import { GpuBatch, ListingFile, PatchView, compare, difference_words, simd } from "./tess_explorer.js";
import { counted, element, formatLine, set, state } from "./state.js";
import { contents, patch } from "./patch.js";
import { draw, over } from "./picture.js";
import { toBits } from "./controls.js";
import * as gpu from "./gpu.js";

// The mistake of the table `tess_verify::mistakes` that a person can plant in the CPU backend's result.
const FAULT = "a bit of a point is wrong: the lowest of the middle u";

let file = null;
// Why the last listing cannot be read.
let refusal = "";
let gpuBusy = false;
let gpuVerdict = { line: "", fault: "", difference: "", view: null };

export function start() {
  element("against").addEventListener("change", () => set({ against: element("against").value }));
  element("fault").addEventListener("change", () => set({ fault: element("fault").value }));
  element("pasted").addEventListener("input", () => readListing(element("pasted").value));
  element("listing-file").addEventListener("change", (event) => openFile(event.target.files[0]));
  element("listing-cases").addEventListener("change", () => set({ line: element("listing-cases").value }));
  element("hundred").addEventListener("click", () => hundred());
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    openFile(event.dataTransfer.files[0]);
  });
}

async function openFile(given) {
  if (given) readListing(await given.text());
}

// Takes a text with listings, shows the first one's patch if none is of the current patch.
function readListing(text) {
  file?.free();
  file = null;
  refusal = "";
  element("listing-cases-label").hidden = true;
  if (text.trim() === "") return update(), draw();
  set({ against: "listing", answer: "compare" });
  try {
    file = new ListingFile(text);
  } catch (error) {
    refusal = error.message;
    return update(), draw();
  }
  const cases = file.cases().split("\n");
  element("listing-cases").replaceChildren(...cases.map((line) => new Option(line, line)));
  element("listing-cases-label").hidden = cases.length < 2;
  if (!cases.includes(state.line)) set({ line: cases[0], view: "" });
  else update(), draw();
}

export function update(keys = new Set()) {
  if (!patch.view) return;
  // A device's differences belong to the patch that they came with.
  if (keys.has("line") && !keys.has("device") && state.device) set({ device: "" });
  element("against").value = state.against;
  element("fault").value = state.fault;
  if (file) element("listing-cases").value = patch.line;
  cpuBadge();
  gpuBadge();
  show();
}

function say(id, kind, text) {
  element(id).dataset.is = kind;
  element(id).textContent = text;
}

// The CPU backend's result; with a fault if one is planted.
function cpuResult() {
  const result = simd(patch.line);
  if (state.fault !== "cpu") return result;
  const faulty = result.with_mistake(FAULT);
  result.free();
  return faulty;
}

function cpuBadge() {
  const result = cpuResult();
  const { equal, first } = JSON.parse(compare(patch.view, result));
  result.free();
  say("badge-cpu", equal ? "equal" : "different", equal ? "CPU equal" : `CPU: ${first}`);
}

// The GPU runs behind; when it is done with one patch it takes the one that is shown then.
async function gpuBadge() {
  const wanted = { line: patch.line, fault: state.fault };
  if (gpuBusy || (gpuVerdict.line === wanted.line && gpuVerdict.fault === wanted.fault)) return;
  gpuBusy = true;
  try {
    const device = await gpu.open();
    const difference = await differenceOf(device, wanted.line, wanted.fault === "gpu");
    gpuVerdict = { ...wanted, ...difference };
    const words = difference.difference;
    say("badge-gpu", words ? "different" : "equal", words ? `GPU: ${words}` : "GPU equal");
  } catch (error) {
    gpuVerdict = { ...wanted, difference: "" };
    say("badge-gpu", "absent", `GPU not compared: ${error.message}`);
  }
  element("badge-gpu").dataset.line = wanted.line;
  element("badge-gpu").dataset.fault = wanted.fault;
  gpuBusy = false;
  if (patch.line !== wanted.line || state.fault !== wanted.fault) gpuBadge();
  else if (state.against === "gpu") show(), draw();
}

// Errors of the shaders in the patches of these case lines; nothing if every bit is equal.
async function differenceOf(device, lines, hasFault) {
  const batch = new GpuBatch(lines);
  try {
    const { points, indices } = await device.tessellate(batch, hasFault);
    const difference = batch.difference(points, indices) ?? "";
    const isOne = !lines.includes("\n");
    const listing = isOne ? batch.listing(points, indices) : "";
    return { difference: isOne ? difference.replace(`${lines}: `, "") : difference, listing };
  } finally {
    batch.free();
  }
}

// Lays the chosen result over the model's.
function show() {
  over.other = null;
  say("verdict", "", "");
  const other = otherResult();
  if (other) {
    const { equal, first, points, primitives } = JSON.parse(compare(patch.view, other));
    const isOtherCase = other.line() !== patch.line;
    over.other = { ...contents(other), isOtherCase, differing: { points, primitives } };
    const counts = `Differences: ${counted(points.length, "point")} and ${counted(primitives.length, "primitive")}.`;
    const isLong = state.against === "listing" && !equal && difference_words(patch.view, other) === undefined;
    const words = isOtherCase ? `In red: ${other.line()}. ` : isLong ? "Too many differences for a link. " : "";
    say("verdict", equal ? "equal" : "different", words + (equal ? "Equal, bit by bit." : `${counts} The first: ${first}`));
    other.free();
  }
}

function otherResult() {
  const { against } = state;
  const other = (parts) => new PatchView(formatLine({ ...patch.parts, ...parts }));
  if (against === "none") return null;
  if (against === "split") return other({ split: patch.parts.split === "ruler" ? "center" : "ruler" });
  if (against === "simd") return cpuResult();
  if (against === "listing") {
    if (!file && !refusal && state.device) return patch.view.with_differences(state.device) ?? null;
    const listing = file?.listing(patch.line);
    if (listing) set({ device: difference_words(patch.view, listing) ?? "" });
    else if (refusal) say("verdict", "different", refusal);
    else say("verdict", "absent", file ? "The listing has no such patch." : "Paste or drop a listing, such as `tess patch` writes.");
    return listing ?? null;
  }
  if (against === "gpu") {
    if (gpuVerdict.line !== patch.line || !gpuVerdict.listing) {
      say("verdict", "absent", element("badge-gpu").textContent);
      return null;
    }
    const listings = new ListingFile(gpuVerdict.listing);
    const view = listings.listing(patch.line);
    listings.free();
    return view;
  }
  return other({ partitioning: against });
}

// A hundred patches of the shown configuration with other factors, on the GPU in one batch.
async function hundred() {
  say("hundred-verdict", "", "Comparing ...");
  const { factors } = patch.parts;
  const lines = Array.from({ length: 100 }, (_, k) =>
    formatLine({ ...patch.parts, factors: factors.map((_, f) => toBits(0.5 + ((k * 37 + f * 11 + k * f * 7) % 650) / 10)) }));
  try {
    const { difference } = await differenceOf(await gpu.open(), lines.join("\n"), state.fault === "gpu");
    say("hundred-verdict", difference ? "different" : "equal", difference || "100 patches equal, bit by bit.");
  } catch (error) {
    say("hundred-verdict", "absent", `Not compared: ${error.message}`);
  }
}
