// Before the package's script in a worker: ends it in the middle of its second job, as a browser ends one that lacks
// memory: without a word.
let jobs = 0;
addEventListener('message', event => {
  if (!event.data.work || ++jobs < 2) return;
  event.stopImmediatePropagation();
  close();
});
