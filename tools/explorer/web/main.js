// The page: loads the WebAssembly, draws the first picture, then starts everything else; redraws whatever a
// change of the state concerns.

import load from "./tess_explorer.js";
import * as state from "./state.js";
import * as controls from "./controls.js";
import * as picture from "./picture.js";

const { TABS, element, set } = state;

const PREFIX = { tab: "view", answer: "answer" };

function startTabs(key) {
  const names = TABS[key];
  names.forEach((name, k) => {
    const tab = element(`tab-${name}`);
    tab.addEventListener("click", () => set({ [key]: name }));
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      const next = names[(k + by + names.length) % names.length];
      set({ [key]: next });
      element(`tab-${next}`).focus();
    });
  });
}

function showTabs(key) {
  for (const name of TABS[key]) {
    const isChosen = state.state[key] === name;
    element(`tab-${name}`).setAttribute("aria-selected", String(isChosen));
    element(`tab-${name}`).tabIndex = isChosen ? 0 : -1;
    element(`${PREFIX[key]}-${name}`).hidden = !isChosen;
  }
}

const prefersDark = matchMedia("(prefers-color-scheme: dark)");

function showTheme() {
  document.documentElement.dataset.theme = state.state.theme || (prefersDark.matches ? "dark" : "light");
}

function startTheme() {
  prefersDark.addEventListener("change", () => set({ theme: "" }));
  element("theme").addEventListener("click", () =>
    set({ theme: document.documentElement.dataset.theme === "dark" ? "light" : "dark" }));
}

// Parts that the first picture does not need are fetched and started after it.
const LATER = ["compare", "animation", "ask", "share", "learn", "surface", "measure"];

async function start() {
  await load({ module_or_path: new URL("tess_explorer_bg.wasm", import.meta.url) });
  const parts = [controls, picture];
  state.onChange((keys) => {
    showTheme();
    Object.keys(TABS).forEach(showTabs);
    parts.forEach((part) => part.update?.(keys));
    document.documentElement.dataset.drawn = state.state.line;
  });
  state.start();
  Object.keys(TABS).forEach(startTabs);
  startTheme();
  parts.forEach((part) => part.start());
  state.showAll();
  await isShown();
  performance.mark("first picture");
  const later = await Promise.all(LATER.map((name) => import(`./${name}.js`)));
  picture.useWebGL();
  later.forEach((part) => part.start());
  // The picture comes last, as it shows what others lay over it.
  parts.splice(1, 0, ...later);
  state.showAll();
  document.documentElement.dataset.ready = "";
}

// Resolves when a picture is on the screen.
const isShown = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

start().catch((error) => {
  element("failure").textContent = `The explorer cannot start: ${error.message}. It needs WebAssembly with SIMD.`;
  throw error;
});
