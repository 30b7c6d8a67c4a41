// The one time all views show, the stretch of time the plots show, and the playing of the one.

export interface Window {
  start: number;
  end: number;
}

type Listener = () => void;

export class Timeline {
  private timeListeners: Listener[] = [];
  private windowListeners: Listener[] = [];
  private stateListeners: Listener[] = [];
  private now: number;
  private shown: Window;
  private playingSince: number | null = null; // wall time of the last frame [ms]
  private rate = 1;

  constructor(
    readonly start: number,
    readonly end: number,
  ) {
    this.now = start;
    this.shown = { start, end };
  }

  get time(): number {
    return this.now;
  }
  get window(): Window {
    return this.shown;
  }
  get zoomed(): boolean {
    return this.shown.start > this.start || this.shown.end < this.end;
  }
  get playing(): boolean {
    return this.playingSince !== null;
  }
  get speed(): number {
    return this.rate;
  }

  onTime(listener: Listener): void {
    this.timeListeners.push(listener);
  }
  onWindow(listener: Listener): void {
    this.windowListeners.push(listener);
  }
  onState(listener: Listener): void {
    this.stateListeners.push(listener);
  }

  setTime(t: number): void {
    const clamped = Math.min(Math.max(t, this.start), this.end);
    if (clamped === this.now) return;
    this.now = clamped;
    this.timeListeners.forEach((listener) => listener());
  }

  // Shows [start, end], cut to the run; a window too short to hold anything is widened.
  setWindow(start: number, end: number): void {
    const shortest = (this.end - this.start) * 1e-4;
    const length = Math.min(Math.max(end - start, shortest), this.end - this.start);
    const middle = (start + end) / 2;
    const from = Math.min(Math.max(middle - length / 2, this.start), this.end - length);
    if (from === this.shown.start && from + length === this.shown.end) return;
    this.shown = { start: from, end: from + length };
    this.windowListeners.forEach((listener) => listener());
  }

  resetWindow(): void {
    this.setWindow(this.start, this.end);
  }

  // Makes the window `factor` times as long, keeping `centre` where it is on the screen.
  zoomAbout(centre: number, factor: number): void {
    const { start, end } = this.shown;
    this.setWindow(centre - (centre - start) * factor, centre + (end - centre) * factor);
  }

  setSpeed(rate: number): void {
    this.rate = rate;
    this.stateListeners.forEach((listener) => listener());
  }

  play(): void {
    if (this.playing) return;
    if (this.now >= this.end) this.setTime(this.start);
    this.playingSince = performance.now();
    this.stateListeners.forEach((listener) => listener());
    requestAnimationFrame(this.advance);
  }

  pause(): void {
    if (!this.playing) return;
    this.playingSince = null;
    this.stateListeners.forEach((listener) => listener());
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  private advance = (wall: number): void => {
    if (this.playingSince === null) return;
    // The frame's time stamp can lie just before the call of play().
    const passed = Math.max(0, wall - this.playingSince) / 1000;
    this.playingSince = wall;
    this.setTime(this.now + passed * this.rate);
    this.keepInWindow();
    if (this.now >= this.end) this.pause();
    else requestAnimationFrame(this.advance);
  };

  // While playing, a zoomed window turns the page when the time runs out of it.
  private keepInWindow(): void {
    const { start, end } = this.shown;
    if (this.now <= end && this.now >= start) return;
    this.setWindow(this.now, this.now + (end - start));
  }
}
