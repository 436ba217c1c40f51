// The package in one piece, for pages that open from a file and for bundlers that do not follow new URL(): the module
// and the worker are text within it.
import { defaults } from './ready.js';
import { MODULE, WORKER } from './inline-data.js';

const decode = () => Uint8Array.from(atob(MODULE), letter => letter.charCodeAt(0));
/// Node's workers accept no Blob, and a browser's with a data: address are of no origin.
const workerAddress = () =>
  globalThis.process?.versions?.node
    ? new URL(`data:text/javascript,${encodeURIComponent(WORKER)}`)
    : URL.createObjectURL(new Blob([WORKER], { type: 'text/javascript' }));

defaults.source ??= decode;
defaults.worker ??= () => new Worker(workerAddress());
defaults.workerAdvice ??= 'scarp/inline makes its worker from a Blob: a content policy needs worker-src blob:';

export * from './api.js';
