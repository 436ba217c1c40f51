// The package with fields that change.
import { defaults } from './ready.js';

defaults.source ??= () => new URL('./live.wasm', import.meta.url);
defaults.worker ??= () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });

export * from './api.js';
export { Live } from './field.js';
