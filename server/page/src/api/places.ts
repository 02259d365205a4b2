// Places for lasting streams. Browsers open only six connections to a host, for all their tabs together: where more
// tabs are open than there are places, the others must leave connections free for each other and for calls.

const kPlaces = 4;

/** Takes a place that is free. The returned function gives it back; undefined: none is free. */
export async function takePlace(): Promise<(() => void) | undefined> {
  if (!("locks" in navigator)) return () => undefined;
  for (let place = 0; place < kPlaces; ++place) {
    const giveBack = await holdIfFree(`cellcrush-stream-${place}`);
    if (giveBack) return giveBack;
  }
  return undefined;
}

// A lock is held until the promise of its callback is settled, and ends with its tab.
function holdIfFree(name: string): Promise<(() => void) | undefined> {
  return new Promise((resolve, reject) => {
    navigator.locks.request(name, { ifAvailable: true }, (lock) => {
      if (!lock) return resolve(undefined);
      return new Promise<void>((giveBack) => resolve(giveBack));
    }).catch(reject);
  });
}
