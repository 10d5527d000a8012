// Puts page.html, style.css and the program with all it uses into one file: node bundle.mjs OUTPUT
import { build } from 'esbuild';
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const { outputFiles } = await build({
  entryPoints: [`${here}src/main.js`],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  legalComments: 'inline',
  write: false,
});
// A function, because `$` means something in a replacement.
const page = readFileSync(`${here}page.html`, 'utf8')
  .replace('<!--varimap-style-->', () => readFileSync(`${here}style.css`, 'utf8'))
  .replace('<!--varimap-program-->', () => outputFiles[0].text);
writeFileSync(process.argv[2], page);
