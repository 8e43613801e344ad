// Decides how much room a stage has for points and primitives, as tess-wgpu/src/stage/room.rs does, which explains why:
// factor 4 for all patches at first, 5/2 of the need when a frame needs more than 7/8, less after 1024 frames that need a
// fifth or less.

const MOST = 2 ** 32 - 1;
const PATIENCE = 1024;

// floor(a * b / c), exact beyond 2^53.
const share = (a, b, c) => Number(BigInt(a) * BigInt(b) / BigInt(c));

export class Room {
  // `uniform` are the counts of one patch at some factors; `bytes` those of a point and of a primitive, `largest` the
  // most bytes of an element of one buffer of points, and `limit` the most bytes of a buffer.
  constructor({ uniform, patches, bytes, largest, budget, limit }) {
    Object.assign(this, { uniform, patches, bytes, largest, budget, limit: limit - limit % 8 });
    Object.assign(this, { since: 0, most: [0, 0], isFixed: false });
  }

  // The counts of all patches at one of the factors.
  #of(factor) {
    const { points, primitives } = this.uniform.find((one) => one.factor === factor);
    return [points, primitives].map((count) => Math.min(count * this.patches, MOST));
  }

  #bytes(room) {
    return room[0] * this.bytes[0] + room[1] * this.bytes[1];
  }

  // The part of a room that frames can ever need and that buffers can hold.
  #possible(room) {
    const held = [this.largest, this.bytes[1]].map((each) => Math.floor(this.limit / each));
    return this.#of(64).map((worst, i) => Math.min(room[i], worst, held[i]));
  }

  // The room before the first frame.
  first() {
    return this.#atMost(this.#of(1), this.#possible(this.#of(4)));
  }

  // The room to have after a frame of this number with these needs; nothing if it stays.
  next(now, frame, needed) {
    if (this.isFixed) return undefined;
    return this.#grown(now, needed) ?? this.#shrunk(now, frame, needed);
  }

  #grown(now, needed) {
    const most = this.#possible([MOST, MOST]);
    const isShort = [0, 1].some((i) => now[i] < most[i] && needed[i] * 8 > now[i] * 7);
    const isFull = this.#bytes(now) + this.bytes[0] + this.bytes[1] > this.budget;
    return isShort && !isFull ? this.#other(now, this.#atMost(now, this.#ample(needed))) : undefined;
  }

  #shrunk(now, frame, needed) {
    this.most = this.most.map((most, i) => Math.max(most, needed[i]));
    const { most } = this;
    const isLull = [0, 1].every((i) => most[i] * 5 <= now[i]);
    if (isLull && frame - this.since < PATIENCE) return undefined;
    Object.assign(this, { since: frame, most: [0, 0] });
    return isLull ? this.#other(now, this.#atMost(this.first(), this.#ample(most))) : undefined;
  }

  #other(now, room) {
    return room[0] !== now[0] || room[1] !== now[1] ? room : undefined;
  }

  // A room of which frames with these needs use two fifths.
  #ample(needed) {
    return this.#possible(needed.map((count) => Math.min(Math.floor(count * 5 / 2), MOST)));
  }

  // The greater of both in each dimension, or as much of it as the budget holds.
  #atMost(least, wanted) {
    const whole = least.map((count, i) => Math.max(count, wanted[i]));
    if (this.#bytes(whole) <= this.budget) return whole;
    // What the budget leaves is divided in the proportion in which the whole exceeds the least.
    const fits = this.#bytes(least) <= this.budget;
    const base = fits ? least : [0, 0], shape = fits ? whole : least;
    const free = this.budget - this.#bytes(base);
    const beyond = shape.map((count, i) => Math.max(count - base[i], 0));
    const all = Math.max(this.#bytes(beyond), 1);
    return this.#possible(base.map((count, i) => Math.min(count + share(beyond[i], free, all), MOST)));
  }
}
