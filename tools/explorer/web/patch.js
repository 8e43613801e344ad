// The patch that is shown: the model's result for the case line, and what lies over it.

import { PatchView } from "./tess_explorer.js";
import { parseLine } from "./state.js";

export const patch = { view: null, line: "", error: "" };

// Computes the patch of a case line. A line that is no case leaves the patch as it is; `error` says why.
export function load(line, error = "") {
  patch.error = error;
  if (line === patch.line) return;
  let view;
  try {
    view = new PatchView(line);
  } catch (thrown) {
    patch.error = thrown.message;
    return;
  }
  patch.view?.free();
  Object.assign(patch, contents(view), { view, line: view.line(), parts: parseLine(view.line()) });
}

// The points, primitives and their number of a view.
export function contents(view) {
  const points = view.points(), indices = view.indices(), size = view.primitive_size();
  return { points, indices, size, primitives: indices.length / size };
}
