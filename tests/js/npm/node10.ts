// Finds types like programs that know no "exports"; compiled, never run.
import { simplifySync } from 'scarp/inline';
import { Tiler } from 'scarp/full';
export const m: number = simplifySync([1, 2, 3, 4], 2, 2, { maxError: 1 }).maxError;
export { Tiler };
