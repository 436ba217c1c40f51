// Serves a folder on this machine. Paths that begin with a name in HEADERS give the same files with these headers.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';

const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
};
const policy = more => ({
  'Content-Security-Policy': `default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; ${more}`,
});
const HEADERS = {
  isolated: { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' },
  strict: { 'Content-Security-Policy': "default-src 'self'" },
  whole: policy("connect-src 'self'; worker-src 'self'"),
  deaf: policy("worker-src 'self'"),
  lone: policy("connect-src 'self'; worker-src 'none'"),
  blob: policy('worker-src blob:'),
  typed: policy("connect-src 'self'; worker-src 'self' blob:; require-trusted-types-for 'script'"),
};

export async function serve(folder) {
  const server = http.createServer((request, response) => {
    let { pathname } = new URL(request.url, 'http://localhost');
    const [, first] = pathname.split('/');
    if (HEADERS[first]) pathname = pathname.slice(first.length + 1);
    const file = path.join(folder, path.normalize(pathname));
    if (!fs.existsSync(file) || !fs.statSync(file).isFile()) return void response.writeHead(404).end();
    const headers = { 'Content-Type': TYPES[path.extname(file)] ?? 'application/octet-stream', ...HEADERS[first] };
    const range = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? '');
    const { size } = fs.statSync(file);
    if (!range || Number(range[1]) >= size) {
      response.writeHead(200, headers);
      return void fs.createReadStream(file).pipe(response);
    }
    const start = Number(range[1]);
    const end = Math.min(Number(range[2]), size - 1);
    response.writeHead(206, { ...headers, 'Content-Range': `bytes ${start}-${end}/${size}` });
    fs.createReadStream(file, { start, end }).pipe(response);
  });
  await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}
