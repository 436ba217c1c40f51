// A browser that lacks memory ends a worker without an event. Its locks are free then, and a waiter for one gets it.
// Node reports each end, and needs none.
const locks = globalThis.process?.versions?.node ? undefined : globalThis.navigator?.locks;

/// In the worker: holds a lock until it ends. The lock's name; null where there are none, as in a page without HTTPS.
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

/// Calls `ended` when the worker is gone that holds the lock.
export function watchLock(name, ended) {
  locks.request(name, ended).catch(() => {});
}
