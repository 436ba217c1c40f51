// The command line that makes the mesh that is shown.

/** One word for a POSIX shell, and no option. A character that no line shows becomes a question mark. */
function quote(name) {
  const word = (name.startsWith('-') ? `./${name}` : name).replace(/\p{Cc}/gu, '?');
  return /^[A-Za-z0-9._/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

const COMMANDS = { greedy: 'classic', high: 'simplify' };
const EFFORTS = { greedy: '--effort fast --order greedy', high: '--effort high' };

/** How the raster was read for the file that the page began with: only words that no shell reads. */
function optionsOf({ command = '' }) {
  const found = String(command).matchAll(
    / --(?:band|te|resolution|decode|nodata|z-scale|z-offset|cell-size|crs)(?: [A-Za-z0-9.:+,=-]+)+?(?= --| -[a-z] |$)/g,
  );
  return [...found].map(([words]) => words).join('');
}

/** Null for the mesh of a file. The page's meshes hold float32, as a GLB does, and the program's own OBJ does not. */
export function commandOf({ field, goal, name, extras }, format) {
  if (!goal) return null;
  const asked = goal.maxTriangles ? `-t ${goal.maxTriangles}` : `-e ${goal.maxError}`;
  const decode = field.decoding && field.decoding !== 'grey' ? ` --decode ${field.decoding}` : '';
  const files = `${quote(field.name)} mesh.${format === 'obj' ? 'glb' : format}`;
  return `scarp ${COMMANDS[name]} ${files} ${asked} ${EFFORTS[name]}${decode}${optionsOf(extras)}`;
}

/** Notes on what the command does not express. */
export function commandNotes({ field }, format) {
  if (!field) return '';
  return [
    field.step > 1 && 'It is of the full raster: more samples, another mesh.',
    format === 'obj' && 'It writes the mesh as GLB: the program fits an OBJ in doubles, and may find another.',
    /\p{Cc}/u.test(field.name) && 'It has ? for what no line shows in the name: write that, or rename the file.',
  ]
    .filter(Boolean)
    .join(' ');
}
