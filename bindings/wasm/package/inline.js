// The package as one script, for pages opened from a file and for bundlers that do not follow new URL(): it contains
// the module and the worker as text.
import { defaults } from './ready.js';
import { MODULE, WORKER } from './inline-data.js';

const decode = () => Uint8Array.from(atob(MODULE), letter => letter.charCodeAt(0));
/// Node's workers accept no Blob, and a browser's workers with a data: address have no origin.
const workerAddress = () =>
  globalThis.process?.versions?.node
    ? new URL(`data:text/javascript,${encodeURIComponent(WORKER)}`)
    : URL.createObjectURL(new Blob([WORKER], { type: 'text/javascript' }));

defaults.source ??= decode;
defaults.worker ??= () => new Worker(workerAddress());
defaults.workerAdvice ??= 'scarp/inline makes its worker from a Blob: a content policy needs worker-src blob:';

export * from './api.js';
