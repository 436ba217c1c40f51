// Precedes the package's script in a worker: ends it silently in the middle of its second job, like a browser without
// memory.
let jobs = 0;
addEventListener('message', event => {
  if (!event.data.work || ++jobs < 2) return;
  event.stopImmediatePropagation();
  close();
});
