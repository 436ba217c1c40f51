// Packs the npm package: pack.mjs BUILD DIST, from the modules in BUILD/bin. Prints the path of DIST/scarp-VERSION.tgz.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

const [build, dist] = process.argv.slice(2).map(folder => path.resolve(folder));
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const root = path.resolve(here, '../..');
const version = /project\(scarp VERSION ([\d.]+)/.exec(fs.readFileSync(`${root}/CMakeLists.txt`, 'utf8'))[1];
const staged = path.join(build, 'npm');

/// The rows of the program's table of options that are also settings of the package, by command and name.
function readRows() {
  const rows = {};
  const told = execFileSync(process.execPath, [`${build}/bin/scarp_settings.js`], { encoding: 'utf8' });
  const isNumber = text => text !== '' && Number.isFinite(Number(text));
  for (const line of told.trim().split('\n')) {
    const [command, name, type, words, least, above, most, range, given, help] = line.split('\t');
    const row = { type };
    for (const [limit, value] of Object.entries({ least, above, most, byDefault: given }))
      if (isNumber(value)) row[limit] = Number(value);
    if (range.includes('nan')) row.nan = true;
    if (type === 'choice') {
      row.choices = words.split(' ').map(word => (isNumber(word) ? Number(word) : word));
      if (row.choices.includes(given)) row.byDefault = given;
      else if (!isNumber(given)) [row.byDefault] = row.choices = ['auto', ...row.choices];
    }
    const limits = least !== '-inf' && most !== 'inf' ? ` From ${least} to ${most}.` : '';
    const numbers = Number.isFinite(row.choices?.[0]) ? ` One of ${row.choices.join(', ')}.` : '';
    row.default = row.byDefault === undefined || row.byDefault === 'auto' ? '' : ` Default: ${row.byDefault}.`;
    row.comment = /^.*?\.(?= |$)/.exec(help)[0] + limits + numbers + row.default;
    (rows[command] ??= {})[name] = row;
  }
  return rows;
}

/// Replaces FromSimplify and FromTile by the types of rows. Fields without a comment get the first sentence of the
/// help; other comments, the default.
function declare(text, rows) {
  const types = { flag: 'boolean', number: 'number', count: 'number', file: 'Numbers | null' };
  return text
    .replace(/(?<!\*\/\n)^( +)(\w+)(?=\?: From(Simplify|Tile)\b)/gm, (field, indent, name, from) => {
      return `${indent}/** ${rows[from.toLowerCase()][name].comment} */\n${field}`;
    })
    .replace(/(?<! Default: [^\n]*)( \*\/\n +)(\w+)(?=\?: From(Simplify|Tile)\b)/g, (_, end, name, from) => {
      return rows[from.toLowerCase()][name].default + end + name;
    })
    .replace(/(\w+)\?: From(Simplify|Tile)\b/g, (_, name, from) => {
      const { type, choices } = rows[from.toLowerCase()][name];
      const listed = choices?.map(one => (Number.isFinite(one) ? 'number' : `'${one}'`));
      return `${name}?: ${types[type] ?? [...new Set(listed)].join(' | ')}`;
    });
}

/// The worker and its imports in one script. Each file becomes a function, after those that it needs, without comments
/// and indentation (no string in these files spans lines).
function joinWorker() {
  const files = [
    'number.js',
    'error.js',
    'settings.js',
    'options.js',
    'module.js',
    'heights.js',
    'mesh.js',
    'simplify.js',
    'hills.js',
    'warm.js',
    'alive.js',
    'worker.js',
  ];
  const parts = files.map(file => {
    const text = fs.readFileSync(`${staged}/${file}`, 'utf8').replace(/^\s*\/\/.*\n|^ +/gm, '');
    const names = [...text.matchAll(/^export (?:async )?(?:const|function|class) (\w+)/gm)].map(([, name]) => name);
    const body = text
      .replace(/^import ({[^}]*}) from '.\/(.*)';$/gm, "const $1 = files['$2'];")
      .replace(/^export /gm, '');
    return `files['${file}'] = (() => {\n${body}return { ${names.join(', ')} };\n})();\n`;
  });
  return `const files = {};\n${parts.join('')}`;
}

fs.rmSync(staged, { recursive: true, force: true });
fs.cpSync(`${here}/package`, staged, { recursive: true });
const rows = readRows();
fs.writeFileSync(
  `${staged}/settings.js`,
  `export const ROWS = ${JSON.stringify(rows, (key, value) => (['comment', 'default'].includes(key) ? undefined : value))};\n`,
);
for (const name of fs.readdirSync(staged).filter(file => file.endsWith('.d.ts'))) {
  const file = path.join(staged, name);
  fs.writeFileSync(file, declare(fs.readFileSync(file, 'utf8'), rows));
}
fs.writeFileSync(
  `${staged}/package.json`,
  fs.readFileSync(`${staged}/package.json`, 'utf8').replace('VERSION', version),
);
for (const [from, to] of [
  [`${here}/README.md`, 'README.md'],
  [`${root}/LICENSE`, 'LICENSE'],
])
  fs.copyFileSync(from, path.join(staged, to));
// vite's dev server repacks scripts of node_modules into another folder, without the files next to them; .jsx is not
// moved.
for (const entry of ['index', 'full', 'lite', 'live', 'delatin', 'martini', 'loaders']) {
  const hasDefault = fs.readFileSync(`${staged}/${entry}.js`, 'utf8').includes('export default');
  fs.writeFileSync(
    `${staged}/${entry}.jsx`,
    `export * from './${entry}.js';\n${hasDefault ? `export { default } from './${entry}.js';\n` : ''}`,
  );
}
const imports = [
  'progress',
  'number',
  'clock_time_get',
  'emscripten_notify_memory_growth',
  'environ_get',
  'environ_sizes_get',
  'proc_exit',
];
for (const name of ['scarp.wasm', 'full.wasm', 'lite.wasm', 'live.wasm']) {
  const bytes = fs.readFileSync(`${build}/bin/${name}`);
  // The linker turns an undefined name into an import.
  const unknown = WebAssembly.Module.imports(new WebAssembly.Module(bytes))
    .map(entry => entry.name)
    .filter(entry => !imports.includes(entry));
  if (unknown.length > 0) throw new Error(`${name} lacks ${unknown.join(', ')}`);
  fs.writeFileSync(path.join(staged, name), bytes);
}
const bytes = fs.readFileSync(`${staged}/scarp.wasm`).toString('base64');
fs.writeFileSync(
  `${staged}/inline-data.js`,
  `export const MODULE = ${JSON.stringify(bytes)};\nexport const WORKER = ${JSON.stringify(joinWorker())};\n`,
);
fs.mkdirSync(dist, { recursive: true });
execFileSync('npm', ['pack', '--silent', '--offline', '--pack-destination', dist], { cwd: staged });
console.log(path.join(dist, `scarp-${version}.tgz`));
