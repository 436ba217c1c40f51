// Serves a folder on this machine. Paths that begin with /isolated or /strict are the same files with headers of their own.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm' };
const HEADERS = {
  isolated: { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' },
  strict: { 'Content-Security-Policy': "default-src 'self'" },
};

export async function serve(folder) {
  const server = http.createServer((request, response) => {
    let { pathname } = new URL(request.url, 'http://localhost');
    const [, first] = pathname.split('/');
    if (HEADERS[first]) pathname = pathname.slice(first.length + 1);
    const file = path.join(folder, path.normalize(pathname));
    if (!fs.existsSync(file) || !fs.statSync(file).isFile()) return void response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': TYPES[path.extname(file)] ?? 'application/octet-stream', ...HEADERS[first] });
    fs.createReadStream(file).pipe(response);
  });
  await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}
