// Where a point or primitive comes from, and every stage of the patch, in the words of `tess explain`.

import { element, set, state } from "./state.js";
import { patch } from "./patch.js";
import { over } from "./picture.js";

// Subjects of the explanation's sections, by how their headings begin.
const ABOUT = {
  "Factors": "Each factor is clamped to the partitioning's range, rounded if the partitioning wants integers, and made a 15.16 fixed-point number. Floating point ends here.",
  "Decisions": "Whether the patch is culled, and every special rule that applied.",
  "Contexts": "Six numbers follow from each factor. They are all that is needed to place points: how many there are, and the two evenly spaced subdivisions that are blended.",
  "Counts": "How much comes out.",
  "Points": "Points come ring by ring, each ring edge by edge. A point lies at the blend of its place in the coarser and in the finer subdivision; ask about a point to see its numbers.",
  "Primitives": "Two rows of points that face each other are stitched: each step advances on one of them and makes one triangle.",
};

export function start() {
  element("overlay").addEventListener("hovered", show);
  for (const [id, kind] of [["pick-point", "p"], ["pick-primitive", "t"]]) {
    element(id).addEventListener("input", () => {
      set({ pick: element(id).value === "" ? "" : kind + element(id).value });
    });
  }
}

export function update(keys) {
  const [kind, number] = [state.pick[0], state.pick.slice(1)];
  for (const [id, own] of [["pick-point", "p"], ["pick-primitive", "t"]]) {
    const wanted = kind === own ? number : "";
    if (element(id).value !== wanted) element(id).value = wanted;
  }
  if (keys.has("line")) stages();
  show();
}

// The element under the pointer, else the one that was picked.
function show() {
  const pick = over.hover || state.pick;
  const text = pick && patch.view.explain(pick), json = pick && patch.view.explain_json(pick);
  const missing = `There is no ${pick[0] === "p" ? "point" : "primitive"} ${Number(pick.slice(1))}.`;
  element("asked").textContent = pick ? text ?? missing : "";
  element("asked-json").textContent = json ? JSON.stringify(JSON.parse(json), null, 2) : "";
}

// A section for each stage; those that are open stay open.
function stages() {
  const [, ...sections] = patch.view.explain("").split("\n\n");
  const parts = sections.join("\n\n").split(/\n\n|\n(?=Decisions)/);
  const old = new Map([...element("stages").children].map((box) => [box.dataset.stage, box]));
  element("stages").replaceChildren(...parts.map((part) => {
    const [heading, ...lines] = part.trim().split("\n");
    const stage = Object.keys(ABOUT).find((name) => heading.startsWith(name)) ?? heading;
    const box = old.get(stage) ?? section(stage);
    box.querySelector("summary").textContent = heading;
    box.querySelector("pre").textContent = lines.join("\n");
    return box;
  }));
}

function section(stage) {
  const box = document.createElement("details");
  box.dataset.stage = stage;
  box.innerHTML = "<summary></summary><p class=hint></p><pre tabindex=0></pre>";
  box.querySelector("p").textContent = ABOUT[stage] ?? "";
  return box;
}
