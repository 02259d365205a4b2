// Calls of functions when something changes, or later.

/** Functions that are called with each value until they are removed. */
export class Listeners<T> {
  private readonly listeners = new Set<(value: T) => void>();

  /** Adds a listener and returns the function that removes it. */
  add(listener: (value: T) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  tell(value: T): void {
    for (const listener of [...this.listeners]) listener(value);
  }
}

/** One call for several wishes. */
export class Later {
  private timer = 0;

  constructor(private readonly call: () => void, private readonly delay: number) {}

  /** Calls some time after the first wish. */
  soon(delay = this.delay): void {
    this.timer ||= window.setTimeout(() => {
      this.timer = 0;
      this.call();
    }, delay);
  }

  /** Calls some time after the last wish. */
  afresh(delay = this.delay): void {
    this.stop();
    this.soon(delay);
  }

  stop(): void {
    clearTimeout(this.timer);
    this.timer = 0;
  }
}
