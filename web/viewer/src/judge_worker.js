// Computes one mesh's errors in the background.
import { judge } from './errors.js';
import { Field } from './field.js';

onmessage = ({ data: { field, mesh } }) => {
  const judged = judge(new Field(field), mesh);
  postMessage(judged, [judged.errors.buffer]);
};
