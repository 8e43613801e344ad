// What a tessellator does, for someone who sees one for the first time; with pictures that move.

import { element, state } from "./state.js";
import { patch } from "./patch.js";
import { play } from "./animation.js";

const PARTITIONINGS = {
  integer: {
    text: "Each factor is rounded up to an integer, and the edge is cut into as many equal segments. When a factor passes an integer, every point of the edge jumps.",
    from: 1, to: 9,
  },
  pow2: {
    text: "Made for factors that are powers of two: 1, 2, 4, 8, up to 64. The fixed function treats it as integer; whoever sets the factors rounds them to powers of two, so that each step cuts every segment in half.",
    from: 1, to: 16,
  },
  fractional_odd: {
    text: "An edge always has an odd number of segments: 1, 3, 5 and so on to 63. Between two odd factors there are as many segments as at the larger one, but two of them, mirrored about the middle, are still short: they grow with the factor. At 3 there are three equal segments. Just above 3 there are five, two of them with hardly any length; as the factor rises these two grow, and at 5 all five are equal. So the mesh changes without a jump, which is why it suits smooth level of detail. The middle of the edge is inside a segment, never a point.",
    from: 1, to: 9,
  },
  fractional_even: {
    text: "An edge always has an even number of segments: 2, 4, 6 and so on to 64. Between two even factors, two short segments, mirrored about the middle, grow with the factor. The middle of the edge is always a point. An edge has two segments at least, so a patch is never just two triangles.",
    from: 2, to: 10,
  },
};

const BASICS = `
<p>A GPU draws a curved surface from few numbers: each <strong>patch</strong> of the surface comes with
<strong>factors</strong> that say how finely to cut it, one for each edge and one or two for the inside. The
<strong>tessellator</strong> turns the factors into <strong>points</strong> in the patch's own coordinates u and v, and
into <strong>triangles</strong> between them. It is a fixed circuit. Direct3D 11 says what it does
to the bit, and this page shows every bit.</p>
<p>Points lie in <strong>rings</strong>: the outermost has the edges' factors, those inside the inside factors. Where the
two meet, a <strong>transition</strong> joins rows of different lengths. An edge's points depend on its own factor
alone, so neighbouring patches that agree on it fit without a crack.</p>
<p>Turn a factor with its slider and watch. Colours show the order in which triangles come out.</p>`;

export function start() {
  element("answer-learn").innerHTML = `<h3>What is this?</h3>${BASICS}
    <h3>Partitioning: where the cuts lie</h3>
    <div id="learn-partitionings"></div>
    <h3>Split order</h3>
    <p>New points split off old ones in an order. <code>ruler</code> takes the positions like the marks of a ruler, halves before quarters, as
    Direct3D 11 does; <code>center</code> begins at the middle of the edge, as the Xbox 360 did. Compare them under Compare.</p>
    <h3>A wrong triangle</h3>
    <p>Paste a device's listing under Compare: what differs from the model is red. Then send the address of this page.</p>`;
  for (const [name, { text }] of Object.entries(PARTITIONINGS)) {
    const box = document.createElement("details");
    box.dataset.partitioning = name;
    box.innerHTML = `<summary>${name}</summary><p>${text}</p><button>Show it</button>`;
    box.querySelector("button").addEventListener("click", () => show(name));
    element("learn-partitionings").append(box);
  }
}

function show(name) {
  const { from, to } = PARTITIONINGS[name];
  const line = `case quad ${name} triangle_cw ${patch.parts.split}${" 40400000".repeat(6)}`;
  play({ line, from, to, seconds: 12 });
}

export function update(keys) {
  if (!keys.has("line") || state.answer !== "learn") return;
  for (const box of element("learn-partitionings").children) {
    box.open = box.dataset.partitioning === patch.parts.partitioning;
  }
}
