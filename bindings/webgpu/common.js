// What the modules of this package share: the shaders' files, the manifest's formulas, and refusals.

export const SHADERS = new URL("./shaders/", import.meta.url);

// A file in the folder of shaders.
export async function get(name, base) {
  const response = await fetch(new URL(name, base));
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return response;
}

// The value of a formula of the manifest. A constant formula is a number.
export function value(formula, numbers) {
  if (typeof formula === "number") return formula;
  const { constant, terms, multiple } = formula;
  const sum = terms.reduce((sum, { times, of, per }) => sum + times * Math.ceil(numbers[of] / per), constant);
  return Math.ceil(sum / multiple) * multiple;
}

export function refuse(what, value, choices) {
  throw new RangeError(`there is no ${what} ${JSON.stringify(value)}; choose ${choices.join(", ")}`);
}

// Refuses an argument that is not of this type, which the browser would report by the name of a member.
export function need(is, message) {
  if (!is) throw new TypeError(message);
}

export function needArray(call, list, example) {
  need(Array.isArray(list), `${call} takes an array of names, such as ${example}, not ${JSON.stringify(list)}`);
}

export function needEncoder(call, encoder) {
  need(encoder?.beginComputePass, `${call} takes a GPUCommandEncoder; \`device.createCommandEncoder()\` makes one`);
}

// The most patches of a frame, which a call that makes a stage takes.
export function needMost(call, patches) {
  need(Number.isInteger(patches) && patches > 0, `${call} takes the most patches of a frame, 1 or more, not ${patches}`);
}

// A frame's number of patches, of which there are at most so many.
export function needPatches(call, patches, most) {
  if (Number.isInteger(patches) && patches >= 0 && patches <= most) return;
  throw new RangeError(`${call} takes 0 to ${most} patches, which \`patches\` of \`load\` set as the most, not ${patches}`);
}

// Sets the user's bind groups from number 0: each a GPUBindGroup, or one with its dynamic offsets.
export function setGroups(pass, groups) {
  groups.forEach((one, number) => one.group ? pass.setBindGroup(number, one.group, one.offsets) : pass.setBindGroup(number, one));
}

// The type of a storage or uniform buffer in a bind group's layout.
export const bindingType = (is_written) => is_written ? "storage" : "read-only-storage";

// The same of a binding that the stage's manifest lists; a job is a uniform buffer.
export const typeOf = ({ buffer, is_written }) => buffer === "job" ? "uniform" : bindingType(is_written);

// The bind group of such bindings over an output's buffers, by name. The first job, of so many bytes, is that of the whole batch.
export function bindGroup(device, layout, bindings, buffers, job_stride) {
  const entries = bindings.map(({ binding, buffer }) =>
    ({ binding, resource: { buffer: buffers[buffer], size: buffer === "job" ? job_stride : undefined } }));
  return device.createBindGroup({ layout, entries });
}
