// In the background: the errors of one mesh.
import { judge } from './errors.js';
import { Field } from './field.js';

onmessage = ({ data: { field, mesh } }) => {
  const judged = judge(new Field(field), mesh);
  postMessage(judged, [judged.errors.buffer]);
};
