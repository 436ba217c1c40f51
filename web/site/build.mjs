// Builds the static site: the documents as pages around the viewer. build.mjs SOURCE SITE MADE: SOURCE is the project's
// folder, MADE has the generated documents; SITE has try.html, example.html and dig.html. Fails for broken links.
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, normalize, relative } from 'node:path';
import { Marked } from 'marked';

const [source, site, made] = process.argv.slice(2);
const style = readFileSync(join(source, 'web/site/style.css'), 'utf8');
const list = folder => readdirSync(folder).filter(name => name.endsWith('.md'));
const madePages = list(made).map(name => `docs/${name}`);
const pages = [
  'README.md',
  'CHANGELOG.md',
  ...madePages,
  ...['docs', 'docs/cli', 'docs/guide', 'bench', 'bench/quality', 'bench/speed'].flatMap(folder =>
    list(join(source, folder)).map(name => `${folder}/${name}`),
  ),
];
const pathOf = page => (madePages.includes(page) ? join(made, page.slice('docs/'.length)) : join(source, page));
const addressOf = page => (page === 'README.md' ? 'index.html' : page.replace(/\.md$/, '.html'));
const slug = text =>
  text
    .toLowerCase()
    .replace(/<[^>]*>/g, '')
    .replace(/&[a-z]+;/g, '')
    .replace(/[^\p{L}\p{N}\s_-]/gu, '')
    .trim()
    .replace(/\s/g, '-');
const anchors = new Map();
const wanted = [];
const copied = new Set();
const missing = [];

/** The site's address for a link of `page`. */
function follow(page, href) {
  if (/^[a-z]+:/.test(href)) return href;
  const [path, anchor] = href.split('#');
  const target = path === '' ? page : normalize(join(dirname(page), path));
  const here = dirname(addressOf(page));
  const end = anchor ? `#${anchor}` : '';
  if (pages.includes(target)) {
    if (anchor) wanted.push([page, target, anchor]);
    return relative(here, addressOf(target)) + end;
  }
  if (!existsSync(join(source, target))) missing.push(`${page}: ${href} leads nowhere`);
  else if (/\.(png|svg|jpg|cpp|csv)$/.test(target)) {
    copied.add(target);
    return relative(here, target) + end;
  }
  return null; // a file of the sources: not on the site
}

function writePage(page) {
  const ids = new Map();
  const address = addressOf(page);
  const up = relative(dirname(address), '.') || '.';
  anchors.set(page, ids);
  const renderer = {
    heading({ tokens, depth }) {
      const html = this.parser.parseInline(tokens);
      const first = slug(html);
      const seen = ids.get(first) ?? 0;
      ids.set(first, seen + 1);
      return `<h${depth} id="${seen ? `${first}-${seen}` : first}">${html}</h${depth}>\n`;
    },
    link({ href, tokens }) {
      const html = this.parser.parseInline(tokens);
      const target = follow(page, href);
      return target === null ? html : `<a href="${target}">${html}</a>`;
    },
    image({ href, text }) {
      return `<img src="${follow(page, href)}" alt="${text}" loading="lazy">`;
    },
  };
  const text = readFileSync(pathOf(page), 'utf8');
  const body = new Marked({ renderer })
    .parse(text)
    .replaceAll('<th></th>', '<td></td>')
    .replaceAll('<table>', '<div class="table" tabindex="0"><table>')
    .replaceAll('</table>', '</table></div>');
  const title = /^# (.*)$/m.exec(text)?.[1].replace(/[`*]/g, '') ?? page;
  const links = [
    ['index.html', 'Scarp'],
    ['try.html', 'Try it with your own file'],
    ['example.html', 'Example'],
    ['dig.html', 'Dig a terrain'],
    ['docs/guide/README.html', 'Guides'],
    ['docs/cli.html', 'Command line'],
    ['docs/options.html', 'Options'],
    ['docs/python.html', 'Python'],
  ];
  mkdirSync(join(site, dirname(address)), { recursive: true });
  const head = `<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">`;
  const nav = links.map(([to, name]) => `<a href="${up}/${to}">${name}</a>`).join(' ');
  writeFileSync(
    join(site, address),
    `<!doctype html>\n<html lang="en"><head>${head}<title>${title}</title><style>${style}</style></head>\n` +
      `<body><nav aria-label="Site">${nav}</nav><main>\n${body}</main></body></html>\n`,
  );
}

for (const page of pages) writePage(page);
for (const file of copied) {
  mkdirSync(join(site, dirname(file)), { recursive: true });
  copyFileSync(join(source, file), join(site, file));
}
for (const [page, target, anchor] of wanted) {
  const ids = anchors.get(target);
  if (!ids.has(anchor) && !ids.has(anchor.replace(/-\d+$/, '')))
    missing.push(`${page}: ${target} has no heading #${anchor}`);
}
if (missing.length) {
  console.error(missing.join('\n'));
  process.exit(1);
}
console.log(`${site}: ${pages.length} documents, ${copied.size} pictures and files`);
