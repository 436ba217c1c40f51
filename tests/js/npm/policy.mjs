// Simplifies in a worker under a content policy; policy.html?inline uses the single-file package.
window.told = import(location.search ? './node_modules/scarp/inline.js' : './node_modules/scarp/index.js')
  .then(({ simplify }) => simplify([0, 0, 0, 9], 2, 2, { maxError: 1 }))
  .then(
    ({ triangleCount }) => `${triangleCount} triangles`,
    error => `${error.code}: ${error.message}`,
  );
