// Judges a mesh in a worker, so that the view can be rotated meanwhile.
import SOURCE from 'judge-source';
import { judge } from './errors.js';

/** The result of judge(). If the browser starts no worker, the page waits for it. */
export function judgeBeside(field, { positions, indices }) {
  return new Promise(done => {
    let worker = null;
    const address = URL.createObjectURL(new Blob([SOURCE], { type: 'text/javascript' }));
    const end = judged => {
      worker?.terminate();
      URL.revokeObjectURL(address);
      done(judged);
    };
    const judgeHere = event => {
      event.preventDefault?.();
      end(judge(field, { positions, indices }));
    };
    try {
      worker = new Worker(address);
      worker.onmessage = ({ data }) => end(data);
      worker.onerror = judgeHere;
      const { samples, cols, rows, affine } = field;
      worker.postMessage({ field: { samples, cols, rows, affine }, mesh: { positions, indices } });
    } catch (error) {
      judgeHere(error);
    }
  });
}
