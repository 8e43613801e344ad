// The tessellation stage of `tess-wgpu` in a browser. It is no part of the page.

import assert from "node:assert/strict";
import { close, open, test } from "./harness.mjs";

// Opens the page with the stage's module beside it.
async function openStage() {
  const page = await open();
  await page.evaluate(async () => {
    window.stage = await import("/stage/tess_explorer_stage.js");
    await window.stage.default("/stage/tess_explorer_stage_bg.wasm");
  });
  return page;
}

// A page that hangs is given up.
const draw = (page, fault = "", isWrong = false) => Promise.race([
  drawHere(page, fault, isWrong),
  new Promise((_, fail) => setTimeout(() => fail(new Error("the page hangs")), 180_000).unref()),
]);

// Draws, while a clock of the page counts: it stands still while something blocks.
const drawHere = (page, fault, isWrong) => page.evaluate(async ([fault, isWrong]) => {
  let ticks = 0;
  const clock = setInterval(() => ticks++, 1);
  try {
    const report = await window.stage.draw_terrain(fault, isWrong);
    const words = new Uint32Array(report.pixels().buffer);
    const { frames, first_scale: scale, points, triangles } = report;
    return { ticks, frames, scale, points, triangles, difference: report.difference(), colours: new Set(words).size, drawn: words.filter((word) => word !== 0).length };
  } catch (error) {
    return { error: error.message };
  } finally {
    clearInterval(clock);
  }
}, [fault, isWrong]);

test("the tessellation stage draws a displaced terrain in a browser, as the model has it", async () => {
  const page = await openStage();
  const report = await draw(page);
  assert.equal(report.error, undefined);
  assert.equal(report.difference, "", "points and indices are the model's");
  assert.ok(report.scale < 1 && report.frames > 1, "the room was too little at first, and grew");
  assert.ok(report.drawn > 256 * 256 / 2 && report.colours > 100, `${report.drawn} pixels in ${report.colours} colours`);
  assert.ok(report.ticks > 0, "nothing blocked");
  const wrong = await draw(page, "", true);
  assert.match(wrong.difference, /^(point|index) /, "a planted fault is found");
  const { error } = await draw(page, "fn broken() -> f32 { return 1u; }\n");
  assert.match(error, /^line 1 of your WGSL: /, "what is wrong is said with the user's line");
  await close(page);
  return `${report.triangles} triangles after ${report.frames} frames`;
});

test("the tessellation stage says that a browser has no WebGPU", async () => {
  const page = await openStage();
  await page.evaluate(() => Object.defineProperty(Navigator.prototype, "gpu", { get: () => undefined }));
  const { error } = await draw(page);
  assert.match(error, /no graphics adapter could be used .*; use a browser that has WebGPU/);
  await close(page);
});
