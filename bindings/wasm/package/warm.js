// Warms up, so that the caller's first raster is fast.
import { hills, SIDE } from './hills.js';
import { simplifySync } from './simplify.js';

export function simplifyHills() {
  for (const effort of ['fast', 'normal']) simplifySync(hills(), SIDE, SIDE, { maxError: 1, effort });
}
