// Reads back what frames needed, some frames later and without waiting.
//
// A frame's encoder copies its numbers into one of several slots of a buffer of the device. The buffer is read by an encoder
// of this file, which it submits itself: so nothing is mapped that a frame's encoder, whenever it is submitted, still writes.

const SLOTS = 8;
// Words of a slot: the frame's number + 1 (0: none yet), a reserved one, the status, the beginning of `fit`.
const STATUS_AT = 2, FIT_AT = 10, WORDS = 18;

export class Feedbacks {
  constructor(device, ladder) {
    const { COPY_SRC, COPY_DST, MAP_READ } = GPUBufferUsage;
    const size = 4 * WORDS * SLOTS;
    this.results = device.createBuffer({ label: "feedback", size, usage: COPY_SRC | COPY_DST });
    this.staging = device.createBuffer({ label: "feedback", size, usage: MAP_READ | COPY_DST });
    Object.assign(this, { device, ladder, last: undefined, underWay: undefined });
  }

  // Records the copies of a frame's numbers. `header` has the frame's number + 1 at byte `at`; `fit` may be missing.
  record(encoder, [header, at], { status }, fit, frame) {
    const slot = 4 * WORDS * (frame % SLOTS);
    encoder.copyBufferToBuffer(header, at, this.results, slot, 4);
    encoder.copyBufferToBuffer(status, 0, this.results, slot + 4 * STATUS_AT, 32);
    if (fit) encoder.copyBufferToBuffer(fit, 0, this.results, slot + 4 * FIT_AT, 32);
  }

  // Asks for the numbers of all frames that were submitted, unless an answer is under way; it ends when they are there.
  ask() {
    this.underWay ??= this.#read().catch(() => {}).finally(() => this.underWay = undefined);
    return this.underWay;
  }

  async #read() {
    const encoder = this.device.createCommandEncoder();
    encoder.copyBufferToBuffer(this.results, 0, this.staging, 0, this.staging.size);
    this.device.queue.submit([encoder.finish()]);
    await this.staging.mapAsync(GPUMapMode.READ);
    const words = new Uint32Array(this.staging.getMappedRange().slice(0));
    this.staging.unmap();
    for (let slot = 0; slot < SLOTS; slot++) this.#take(words.subarray(slot * WORDS, (slot + 1) * WORDS));
  }

  #take(words) {
    const frame = words[0] - 1;
    if (frame < (this.last?.frame ?? 0)) return;
    const long = (at) => words[at] + words[at + 1] * 2 ** 32;
    const had = [long(STATUS_AT), long(STATUS_AT + 2)];
    // Without the passes of `fit` its words are zero, and the batch's own numbers are the needs.
    const counted = [long(FIT_AT + 4), long(FIT_AT + 6)];
    const [points, primitives] = counted.some((count) => count > 0) ? counted : had;
    const drawn = words[STATUS_AT + 4] === 0 ? had[1] : 0;
    this.last = { frame, points, primitives, drawn, scale: this.ladder[words[FIT_AT]] ?? 1 };
  }

  destroy() {
    this.results.destroy();
    this.staging.destroy();
  }
}
