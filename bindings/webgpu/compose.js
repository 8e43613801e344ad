// Joins the user's WGSL with the stage's text, as tess-wgpu does: the user's text comes first, so that its lines keep their
// numbers. A test compares the results with the files of `tess shaders --stage FILE`.

import { need } from "./common.js";

// Types of members: WGSL's name, the components' format as an attribute, and their number.
const TYPES = Object.fromEntries([["f32", "float32", "f"], ["u32", "uint32", "u"], ["i32", "sint32", "i"]].flatMap(
  ([scalar, format, letter]) => [1, 2, 3, 4].map((count) => count === 1 ? [scalar, [scalar, format, 1]]
    : [`vec${count}${letter}`, [`vec${count}<${scalar}>`, `${format}x${count}`, count]])));

// Where WGSL puts the members of a struct: a vector of 3 is aligned like one of 4.
export function membersOf(what, members) {
  need(members && typeof members === "object", `${what} takes an object of members and types, such as { position: "vec4f" }`);
  let end = 0, most = 4;
  const placed = Object.entries(members).map(([name, short]) => {
    const [type, format, count] = TYPES[short] ?? [];
    need(type, `${what} takes types like ${Object.keys(TYPES).join(", ")}; \`${name}\` has ${JSON.stringify(short)}`);
    const align = 4 * (count === 3 ? 4 : count);
    const offset = Math.ceil(end / align) * align;
    end = offset + 4 * count;
    most = Math.max(most, align);
    return { name, type, format, count, offset };
  });
  return { members: placed, end, stride: Math.ceil(end / most) * most };
}

// The struct `Vertex` of these members in one line, and the vertex buffer that holds it. A `position` of four components is
// the one that is drawn; like the other members, it is an attribute, with the lowest number that is left.
export function vertexOf(given) {
  const { members, stride } = membersOf("vertex", given);
  const isBuiltin = ({ name, type }) => name === "position" && type === "vec4<f32>";
  const others = members.filter((one) => !isBuiltin(one));
  const attributes = members.map((one) =>
    ({ ...one, shaderLocation: isBuiltin(one) ? others.length : others.indexOf(one) }));
  const text = attributes.map((one) => {
    const flat = one.type.includes("f32") ? "" : " @interpolate(flat)";
    return `${isBuiltin(one) ? "@builtin(position)" : `@location(${one.shaderLocation})${flat}`} ${one.name}: ${one.type}`;
  });
  return { wgsl: `struct Vertex { ${text.join(", ")} } `, stride, attributes, isDrawable: members.some(isBuiltin) };
}

// Whether a text has this word outside of comments.
export const uses = (text, word) => new RegExp(`\\b${word}\\b`).test(text.replace(/\/\/.*|\/\*[^]*?\*\//g, " "));

// The user's WGSL, the types and helpers, one of the stage's parts, and what the user's WGSL calls of the draws.
export function joined(parts, user, own, group) {
  const called = parts.draws.filter(([name]) => uses(user, name)).map(([, , text]) => text);
  const factors = uses(user, "tess_factors") ? parts.factors : "";
  return [user, parts.shared, (own + factors).replaceAll("GROUP", group) + called.join("")].join("\n");
}

// The parts of draws that compute their points.
const PULLED = { points: "vertex_pulled", corners: "vertex_unindexed" };

// The module of a draw. `vertex` is given where points are evaluated, and `pull` where the vertex shader computes them.
export function vertexModule(parts, user, group, { project = "", vertex, pull }) {
  const called = parts.draws.filter(([name]) => uses(user, name));
  let own = parts[PULLED[pull] ?? "vertex_stored"];
  if (vertex) {
    const loaded = vertex.attributes.map(({ shaderLocation, type }, i) => `@location(${shaderLocation}) tess_${i}: ${type}`);
    const made = `Vertex(${vertex.attributes.map((_, i) => `tess_${i}`).join(", ")})`;
    own = parts.vertex_evaluated.replaceAll("LOADED", loaded.join(", ")).replaceAll("VERTEX", made);
  }
  own = own.replaceAll(" BUILTINS", called.map(([name, builtin]) => `, @builtin(${builtin}) ${name}_now: u32`).join(""))
    .replaceAll("BEGIN", called.map(([name]) => `${name}_value = ${name}_now;`).join(""))
    .replaceAll("PROJECT", project);
  return joined(parts, user, own, group);
}

// Compiles a module that begins with the user's WGSL, and reports errors by the user's lines.
export async function compile(device, label, code, user, needs) {
  device.pushErrorScope("validation");
  const module = device.createShaderModule({ label, code });
  const [{ messages }] = await Promise.all([module.getCompilationInfo(), device.popErrorScope()]);
  const error = messages.find(({ type }) => type === "error");
  if (!error) return module;
  const { lineNum, message } = error;
  if (lineNum >= 1 && lineNum <= user.split("\n").length) throw new Error(`line ${lineNum} of your WGSL: ${message}`);
  throw new Error(`your WGSL does not go with the stage (${message}); it needs ${needs}`);
}
