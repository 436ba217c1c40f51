// The package in its usual form, with separate .wasm file and worker.
import { defaults } from './ready.js';

defaults.source ??= () => new URL('./scarp.wasm', import.meta.url);
defaults.worker ??= () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });

export * from './api.js';
