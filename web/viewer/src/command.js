// The command line that makes the mesh that is shown.

/** One word for a POSIX shell, and no option. What no line shows becomes a question mark. */
function quote(name) {
  const word = (name.startsWith('-') ? `./${name}` : name).replace(/\p{Cc}/gu, '?');
  return /^[A-Za-z0-9._/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

const EFFORTS = { greedy: '--effort fast --order greedy', high: '--effort high' };

/** Null for the mesh of a file. */
export function command_of({ field, goal, name }, format) {
  if (!goal) return null;
  const asked = goal.maxTriangles ? `-t ${goal.maxTriangles}` : `-e ${goal.maxError}`, decode = field.decoding && field.decoding !== 'grey' ? ` --decode ${field.decoding}` : '';
  return `scarp simplify ${quote(field.name)} mesh.${format} ${asked} ${EFFORTS[name]}${decode}`;
}
