// The command line that makes the mesh that is shown.

/** One word for a POSIX shell, and no option. What no line shows becomes a question mark. */
function quote(name) {
  const word = (name.startsWith('-') ? `./${name}` : name).replace(/\p{Cc}/gu, '?');
  return /^[A-Za-z0-9._/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

const EFFORTS = { greedy: '--effort fast --order greedy', high: '--effort high' };

/** How the raster was read for the file that the page began with: only words that no shell reads. */
function options_of({ command = '' }) {
  const found = String(command).matchAll(/ --(?:band|te|resolution|decode|nodata|z-scale|z-offset|cell-size|crs)(?: [A-Za-z0-9.:+-]+)+?(?= --| -[a-z] |$)/g);
  return [...found].map(([words]) => words).join('');
}

/** Null for the mesh of a file. */
export function command_of({ field, goal, name, extras }, format) {
  if (!goal) return null;
  const asked = goal.maxTriangles ? `-t ${goal.maxTriangles}` : `-e ${goal.maxError}`, decode = field.decoding && field.decoding !== 'grey' ? ` --decode ${field.decoding}` : '';
  return `scarp simplify ${quote(field.name)} mesh.${format} ${asked} ${EFFORTS[name]}${decode}${options_of(extras)}`;
}
