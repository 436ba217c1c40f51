// The command line that makes the displayed mesh.

/** One word for a POSIX shell that is no option. Control characters become question marks. */
function quote(name) {
  const word = (name.startsWith('-') ? `./${name}` : name).replace(/\p{Cc}/gu, '?');
  return /^[A-Za-z0-9._/-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

const COMMANDS = { greedy: 'classic', high: 'simplify' };
const EFFORTS = { greedy: '--effort fast --order greedy', high: '--effort high' };

/** The options with which the page's first raster was read: only words without a meaning in a shell. */
function optionsOf({ command = '' }) {
  const found = String(command).matchAll(
    / --(?:band|te|resolution|decode|nodata|z-scale|z-offset|cell-size|crs)(?: [A-Za-z0-9.:+,=-]+)+?(?= --| -[a-z] |$)/g,
  );
  return [...found].map(([words]) => words).join('');
}

/** Null for the mesh of a file. The page's meshes are float32, like a GLB, but unlike the program's OBJ. */
export function commandOf({ field, goal, name, extras }, format) {
  if (!goal) return null;
  const asked = goal.maxTriangles ? `-t ${goal.maxTriangles}` : `-e ${goal.maxError}`;
  const decode = field.decoding && field.decoding !== 'grey' ? ` --decode ${field.decoding}` : '';
  const files = `${quote(field.name)} mesh.${format === 'obj' ? 'glb' : format}`;
  return `scarp ${COMMANDS[name]} ${files} ${asked} ${EFFORTS[name]}${decode}${optionsOf(extras)}`;
}

/** Notes on settings that the command cannot express. */
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
