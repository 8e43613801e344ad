// Surfaces: drawn by the GPU and by the CPU, and kept by a link.

import assert from "node:assert/strict";
import { close, colours, open, openDrawing, openWithoutGpu, picture, pixels, test } from "./harness.mjs";

const text = (page, id) => page.textContent(`#${id}`);

// Waits until what is chosen is drawn; who drew it.
async function drawn(page) {
  await page.evaluate(async () => {
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    // The first frame takes the change, the others show it.
    await frame();
    await (await import("./surface.js")).settled();
    await frame();
    await frame();
  });
  return page.getAttribute("#surface-note", "data-by");
}

// The view that these words of the address describe, drawn `by` the GPU or the CPU: pixels and counts.
async function shown(page, words, by) {
  await page.evaluate(async (hash) => {
    if (location.hash === `#${hash}`) return;
    await new Promise((done) => {
      addEventListener("hashchange", done, { once: true });
      location.hash = hash;
    });
  }, `tab=surface&by=${by}&${words}`);
  assert.equal(await drawn(page), by, `${words}: ${await text(page, "surface-note")}`);
  return { ...await pixels(page, "solids"), counts: await text(page, "surface-counts") };
}

// The part of the pixels that a viewer would call different: by an eighth of a channel's range or more.
function different(one, other) {
  assert.deepEqual(one.size, other.size);
  let count = 0;
  for (let k = 0; k < one.data.length; k += 4) {
    if ([0, 1, 2].some((channel) => Math.abs(one.data[k + channel] - other.data[k + channel]) >= 32)) count++;
  }
  return count / (one.data.length / 4);
}

// Edges of triangles are smoothed in two ways; more than that much of a picture is a fault.
const TOLERANCE = 0.002;

const VIEWS = [
  "surface=teapot&wire=1&factor=5",
  "surface=terrain&wire=&rule=distance&factor=20&eye=0.300,0.600,1.800",
  "surface=flat&wire=1&factor=9.3&eye=1.200,0.900,2.000",
];

test("the GPU draws every surface as the CPU does", async () => {
  const page = await openDrawing("");
  const parts = [];
  for (const view of VIEWS) {
    const [gpu, cpu] = [await shown(page, view, "gpu"), await shown(page, view, "cpu")];
    assert.ok(new Set(new Uint32Array(gpu.data.buffer, gpu.data.byteOffset, gpu.data.length / 4)).size > 20, `${view}: drawn`);
    assert.equal(gpu.counts, cpu.counts, view);
    const part = different(gpu, cpu);
    parts.push(part);
    assert.ok(part <= TOLERANCE, `${view}: ${part} of the pixels differ`);
  }
  await shown(page, VIEWS[0], "gpu");
  await picture(page, "surface");
  await close(page);
  return `at most ${(100 * Math.max(...parts)).toFixed(3)} % of the pixels differ`;
});

test("a fault in the GPU's shaders shows in its picture", async () => {
  const page = await openDrawing("");
  await page.evaluate(() => {
    const make = GPUDevice.prototype.createShaderModule;
    GPUDevice.prototype.createShaderModule = function (descriptor) {
      return make.call(this, { ...descriptor, code: descriptor.code.replace("HALF) >> 16u", "HALF) >> 17u") });
    };
  });
  const [gpu, cpu] = [await shown(page, VIEWS[0], "gpu"), await shown(page, VIEWS[0], "cpu")];
  const part = different(gpu, cpu);
  assert.ok(part > 10 * TOLERANCE, `${part} of the pixels differ`);
  await close(page);
});

test("factors by distance follow the eye, unless they are kept, also by a link", async () => {
  const page = await open("#tab=surface&by=cpu&surface=terrain&rule=distance&factor=9");
  const counts = () => text(page, "surface-counts");
  const move = async (key) => {
    await page.focus("#solid");
    for (let k = 0; k < 5; k++) await page.keyboard.press(key);
    assert.equal(await drawn(page), "cpu");
  };
  const home = await counts();
  await move("+");
  const near = await counts();
  assert.notEqual(near, home, "nearer is finer");
  await page.check("#freeze");
  await move("-");
  await move("ArrowLeft");
  assert.equal(await counts(), near, "the factors are kept");
  const before = await pixels(page, "solids");
  await page.waitForFunction(() => location.hash.includes("kept="));
  const other = await open(new URL(page.url()).hash);
  await drawn(other);
  assert.equal(await text(other, "surface-counts"), near, "the link keeps them");
  assert.ok(await other.isChecked("#freeze"));
  assert.ok(different(before, await pixels(other, "solids")) === 0, "the same picture");
  await close(other);
  await page.uncheck("#freeze");
  await drawn(page);
  assert.notEqual(await counts(), near, "they follow the eye again");
  await close(page);
});

test("without WebGPU the CPU tessellates surfaces, and the page says so", async () => {
  const page = await openWithoutGpu("#tab=surface&surface=flat");
  await page.waitForFunction(() => document.getElementById("surface-note").dataset.by === "cpu");
  assert.match(await text(page, "surface-note"), /this browser has no WebGPU/);
  assert.ok(await colours(page, "solids") > 20, "it is drawn");
  await close(page);
});
