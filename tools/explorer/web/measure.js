// How fast this browser's CPU and GPU are at the workloads of `tess bench`.

import { CpuBench, GpuBatch, workload_names } from "./tess_explorer.js";
import { element, state } from "./state.js";
import { copy } from "./share.js";
import * as gpu from "./gpu.js";

// Each number is the best of repeated passes that together take this many seconds, or of one pass.
const seconds = () => Number(element("measure-seconds").value);
let isListed = false;

export function start() {
  element("measure").addEventListener("click", measure);
  element("copy-table").addEventListener("click", () => copy(tableText()).catch((error) => note(error.message)));
}

export function update() {
  if (state.tab !== "measure" || isListed) return;
  isListed = true;
  element("rates").tBodies[0].replaceChildren(...JSON.parse(workload_names()).map((name) => {
    const row = document.createElement("tr");
    row.dataset.workload = name;
    [name, "", "", ""].forEach((text) => (row.insertCell().textContent = text));
    return row;
  }));
}

const note = (text) => (element("measure-note").textContent = text);

async function measure() {
  element("measure").disabled = true;
  let device = null, missing = "";
  try {
    device = await gpu.open();
  } catch (error) {
    missing = ` Without the GPU: ${error.message}.`;
  }
  for (const row of element("rates").tBodies[0].rows) {
    note(`Measuring ${row.dataset.workload} ...${missing}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
    const [primitives, cpu] = await measureCpu(row.dataset.workload);
    row.cells[1].textContent = primitives.toLocaleString("en");
    row.cells[2].textContent = millions(cpu);
    if (!device) continue;
    try {
      row.cells[3].textContent = millions(await measureGpu(device, row.dataset.workload));
    } catch (error) {
      row.cells[3].textContent = "failed";
      missing += ` ${row.dataset.workload} failed on the GPU: ${error.message}.`;
    }
  }
  note(`Best of several passes.${missing}`);
  element("measure").disabled = false;
}

// Passes to time together: a browser's clock has steps of up to a millisecond.
const LEAST = 0.03;

const millions = (rate) => (rate / 1e6).toFixed(rate < 1e6 ? 4 : 1);

// The least seconds that one pass took.
async function bestOf(passes) {
  let best = Infinity, spent = 0, times = 1;
  do {
    const began = performance.now();
    await passes(times);
    const took = (performance.now() - began) / 1000;
    spent += took;
    if (took < LEAST) times *= 2;
    else best = Math.min(best, took / times);
  } while (spent < seconds() || best === Infinity);
  return best;
}

async function measureCpu(name) {
  const bench = new CpuBench(name);
  const primitives = bench.pass();
  const best = await bestOf(async (times) => {
    for (let k = 0; k < times; k++) bench.pass();
  });
  bench.free();
  return [primitives, primitives / best];
}

async function measureGpu(device, name) {
  // A mere trial needs less output.
  const batch = GpuBatch.workload(name, seconds() > 0 ? 64 : 2);
  const prepared = await device.prepare(batch);
  if (seconds() > 0) await device.run(prepared);
  const best = await bestOf((times) => device.run(prepared, times));
  const primitives = batch.primitives();
  prepared.destroy();
  batch.free();
  return primitives / best;
}

// The table as text with tabs, and the browser that made it.
function tableText() {
  const rows = [...element("rates").rows].map((row) => [...row.cells].map((cell) => cell.textContent).join("\t"));
  return [`# ${navigator.userAgent}`, ...rows].join("\n") + "\n";
}
