// The C core in WebAssembly (web/core/live.h says what each call does): bytes in, columns by name out. Angles in radians, units
// of the run. Runs in a page, in a worker and in Node.

// Bytes of base64, as the page carries the module and the flat models.
export function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Whether this browser can run the core, which the page carries compressed.
export const canRun = () =>
  [globalThis.Worker, globalThis.DecompressionStream].every((part) => typeof part === "function") &&
  typeof WebAssembly === "object";

// The bytes of the module that compressed ones stand for.
export function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// The doubles in bytes, whatever their alignment. Little-endian, as base64 data in the page are.
export function doublesOf(bytes) {
  return new Float64Array(Uint8Array.from(bytes).buffer);
}

export class Core {
  // module: bytes, or a WebAssembly.Module
  static async load(module) {
    const made = await WebAssembly.instantiate(module, {});
    return new Core((made.instance ?? made).exports);
  }

  constructor(exports) {
    this.calls = exports;
    this.columns = Array.from({ length: exports.live_columns() }, (_, i) => this.text(exports.live_column_name(i)));
    this.place = Object.fromEntries(this.columns.map((name, i) => [name, i]));
  }

  // Views of the memory are taken anew for each use: when it grows, those before are void.
  doubles(address, count) {
    return new Float64Array(this.calls.memory.buffer, address, count);
  }

  text(address) {
    if (address === 0) return "";
    const memory = new Uint8Array(this.calls.memory.buffer);
    return new TextDecoder().decode(memory.slice(address, memory.indexOf(0, address)));
  }

  // Takes a study in: its flat model as Float64Array, and the places of its five base units, or -1, for sentences.
  // Throws an Error with the core's sentence if the model is not valid.
  begin(flat, chosen = [-1, -1, -1, -1, -1]) {
    this.calls.live_set_units(...chosen);
    const address = this.calls.live_input(flat.length);
    if (address === 0) throw new Error("there is not enough memory for the study");
    this.doubles(address, flat.length).set(flat);
    if (this.calls.live_begin() !== 0) throw new Error(this.message);
  }

  restart() {
    this.calls.live_restart();
  }

  // Any of stiffness, damping (gains of all legs), period, delay (times), feedforward (true or false), disturbance, amplitude,
  // frequency (factors).
  set(settings) {
    for (const [name, value] of Object.entries(settings)) {
      const call = this.calls[`live_set_${name}`];
      if (!call) throw new Error(`the core has no setting ${name}`);
      call(Number(value));
    }
  }

  // A force on the load at its centre of mass, base axes, until the next call.
  push(x, y, z) {
    this.calls.live_push(x, y, z);
  }

  // Goes on; "done" while the motion does, else the word for its end, and `message` says more.
  advance(duration, step) {
    return this.text(this.calls.live_cause_name(this.calls.live_advance(duration, step)));
  }

  // Why begin() failed or the motion ended, as a sentence; the leg that ended it, 1 … 6, or 0.
  get message() {
    return this.text(this.calls.live_message());
  }

  get leg() {
    return this.calls.live_end_leg();
  }

  // The row at the present time, by place[name]; a copy, which may be handed to another thread.
  row() {
    return this.doubles(this.calls.live_row(), this.columns.length).slice();
  }

  // Where the program is: x, y, z of the top frame's origin, roll, pitch, yaw.
  program() {
    return this.doubles(this.calls.live_program(), 6).slice();
  }

  // Leg lengths, their rates and condition numbers of rows of 12 numbers (web/core/derived.h): rows of 13.
  derived(rows) {
    const count = rows.length / 12;
    const address = this.calls.derived_input(count);
    if (address === 0) throw new Error("there is not enough memory for the table");
    this.doubles(address, rows.length).set(rows);
    const out = this.calls.derived_find();
    if (out === 0) throw new Error("there is not enough memory for the table");
    return this.doubles(out, 13 * count).slice();
  }

  // The whole study as it came: {cause, rows, data}, the rows one after the other.
  run() {
    const cause = this.text(this.calls.live_cause_name(this.calls.live_run()));
    const rows = this.calls.live_run_rows();
    return { cause, rows, data: this.doubles(this.calls.live_run_data(), rows * this.columns.length).slice() };
  }
}
