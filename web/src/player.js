// The page's clock: one time for the scene and all curves.

/** Pause at the end of a repeated run before it begins again, in seconds. */
const REST = 1.2;

export class Player {
  /** @param duration end of the recording; @param step time between rows, the unit of stepping and scrubbing;
   *  @param pace units of time that pass in a second. */
  constructor(duration, step, pace = 1) {
    this.pace = pace;
    this.duration = duration;
    this.step = step;
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    this.loop = true;
    this.rested = 0;
    this.listeners = new Set();
  }

  /** Calls `listener(player)` whenever time or state changes. */
  listen(listener) {
    this.listeners.add(listener);
    listener(this);
  }

  changed() {
    for (const listener of this.listeners) listener(this);
  }

  /** To a time, held within the recording. */
  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.duration);
    this.rested = 0;
    this.changed();
  }

  /** To the row nearest to a time: there all numbers shown are those of the table. */
  seekRow(time) {
    this.seek(Math.round(time / this.step) * this.step);
  }

  stepRows(count) {
    this.pause();
    this.seekRow(Math.round(this.time / this.step) * this.step + count * this.step);
  }

  play() {
    if (this.time >= this.duration) this.time = 0;
    this.playing = true;
    this.changed();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.seekRow(this.time);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Goes on by so many seconds of the reader's time. */
  advance(seconds) {
    // a picture's time may lie before the moment at which the clock was started
    if (!this.playing || this.duration <= 0 || !(seconds > 0)) return;
    if (this.time >= this.duration) {
      if (!this.loop) return this.pause();
      this.rested += seconds;
      if (this.rested < REST) return;
      return this.seek(0);
    }
    this.time = Math.min(this.time + seconds * this.speed * this.pace, this.duration);
    this.changed();
  }
}
