// A browser short of memory ends a worker without an event, but releases its locks, so a waiter acquires them. Node
// reports each end, and needs no lock.
const locks = globalThis.process?.versions?.node ? undefined : globalThis.navigator?.locks;

/// In the worker: holds a lock until the worker ends. Returns the lock's name; null without locks, as in a page without
/// HTTPS.
export function holdLock() {
  if (!locks) return Promise.resolve(null);
  const name = `scarp ${Math.random()} ${performance.now()}`;
  return new Promise(resolve => {
    locks
      .request(name, () => {
        resolve(name);
        return new Promise(() => {});
      })
      .catch(() => resolve(null));
  });
}

/// Calls `ended` when the worker that holds the lock has ended.
export function watchLock(name, ended) {
  locks.request(name, ended).catch(() => {});
}
