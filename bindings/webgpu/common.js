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

// The type of a storage or uniform buffer in a bind group's layout.
export const bindingType = (is_written) => is_written ? "storage" : "read-only-storage";
