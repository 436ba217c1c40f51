// The package as most have it: beside its .wasm file and its worker.
import { defaults, findModule, makeMovedWorker } from './ready.js';

const beside = () => new URL('./scarp.wasm', import.meta.url);
defaults.source ??= () => findModule(beside());
defaults.worker ??= () => makeMovedWorker(beside()) ?? new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });

export * from './api.js';
