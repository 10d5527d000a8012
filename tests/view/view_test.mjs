// Uses the page of varimap-view as a person would: node view_test.mjs CHROMIUM PAGE FOLDER [PICTURES]
// Landmarks are picked, dragged, named and saved into FOLDER; PICTURES: folder for screenshots. Prints times.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { Browser } from './browser.mjs';

const [program, page, folder, pictures] = process.argv.slice(2);
const browser = new Browser(program, `${folder}/profile`);

// The page's point where face f of a side is drawn, if nothing hides it.
const seen = (side, f) => browser.evaluate(`(() => {
  const { view, surfaces } = varimap, box = document.getElementById('canvas').getBoundingClientRect();
  const at = view.project('${side}', surfaces['${side}'].side.mixed(${f}, [.3, .3, .4]));
  return at.hidden || !at.inside ? null : [at.x + box.left, at.y + box.top];
})()`);
async function seenFaces(side, count) {
  const faces = await browser.evaluate(`varimap.surfaces['${side}'].side.faceCount`);
  const found = [];
  for (let f = 0; f < faces && found.length < count; f += Math.ceil(faces / 40)) {
    const point = await seen(side, f);
    if (point) found.push(point);
  }
  assert.equal(found.length, count, `faces in sight on the ${side}`);
  return found;
}
const count = () => browser.evaluate('varimap.landmarks.items.length');
const item = (i) => browser.evaluate(`JSON.parse(JSON.stringify(varimap.landmarks.items[${i}]))`);
const distance = (a, b) => Math.hypot(...a.map((x, axis) => x - b[axis]));
async function saved(name) {
  await browser.download(name, 20);
  return readFileSync(`${folder}/${name}`, 'utf8');
}
async function picture(name) {
  if (pictures) writeFileSync(`${pictures}/${name}.png`, await browser.screenshot());
}

// Side by side: a caption for each, another picture; nothing is picked meanwhile.
async function compareCandidates() {
  const candidates = await browser.evaluate('varimap.data.candidates.length');
  assert.equal(await browser.evaluate(`document.getElementById('compare').hidden`), candidates === 0);
  if (candidates === 0) return;
  const pair = await browser.screenshot();
  await browser.key('c');
  await browser.until('varimap.view.scenes.length > 2', 5);
  await new Promise((done) => setTimeout(done, 300));
  assert.equal(await browser.evaluate(`document.querySelectorAll('#candidates div').length`), candidates + 1);
  assert.equal(await browser.evaluate(`varimap.view.hitAt(100, 300).hit`), null);
  assert.notDeepEqual(await browser.screenshot(), pair);
  await picture('candidates');
  await browser.key('c');
  assert.equal(await browser.evaluate('varimap.view.scenes.length'), 2);
  console.log(`candidates: ${candidates}`);
}

async function run() {
  await browser.open(pathToFileURL(page).href);
  await browser.until('Boolean(window.varimap)', 60);
  await browser.downloadTo(folder);
  console.log(`first picture: ${await browser.evaluate('document.documentElement.dataset.ready')} ms`);

  // The cursor's partner.
  const [first, second, third] = await seenFaces('source', 3);
  await browser.mouse('mouseMoved', ...first);
  assert.match(await browser.evaluate(`document.getElementById('status').textContent`), /^source .* → target /);
  assert.equal(await browser.evaluate(`document.querySelectorAll('.cursor:not([hidden])').length`), 2);
  const perPick = await browser.evaluate(`(() => {
    const box = document.getElementById('canvas'), start = performance.now();
    let hits = 0;
    for (let i = 0; i < 200; i++) {
      const { side, hit } = varimap.view.hitAt((.2 + .003 * (i % 100)) * box.clientWidth, (.3 + .002 * i) * box.clientHeight);
      if (hit && varimap.view.carried(side, hit)) hits++;
    }
    return (performance.now() - start) / 200;
  })()`);
  console.log(`a point there: ${perPick.toFixed(2)} ms`);

  // Picked on the source: a partner is suggested; picked again on the target.
  const before = await count();
  await browser.key('p');
  await browser.click(...second);
  assert.equal(await count(), before + 1);
  assert.equal((await item(before)).suggested, 'target');
  const [place] = await seenFaces('target', 1);
  await browser.click(...place);
  assert.equal(await count(), before + 1);
  assert.equal((await item(before)).suggested, null);
  // Picked on the target first.
  await browser.click(...(await seenFaces('target', 2))[1]);
  assert.equal(await count(), before + 2);
  assert.equal((await item(before + 1)).suggested, 'source');
  // By keys alone, from the cross in the middle of a side: what was suggested there is put right.
  await browser.evaluate(`document.getElementById('canvas').focus()`);
  await browser.key(',');
  const pickedByKey = await browser.evaluate('Boolean(varimap.underCross())');
  await browser.key(' ');
  assert.equal(await count(), before + 2);
  if (pickedByKey) assert.equal((await item(before + 1)).suggested, null);

  // Dragged and named.
  const old = await item(before);
  const marker = await browser.evaluate(`(() => { const box = document.querySelector('.marker[data-side=source][data-index="${before}"]').getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2]; })()`);
  await browser.drag(marker, third);
  const moved = await item(before);
  assert.ok(distance(moved.source.point, old.source.point) > 1e-6, 'the landmark moved');
  assert.deepEqual(moved.target, old.target);
  await browser.evaluate(`(() => { const name = document.querySelectorAll('#list input')[${before}];
    name.value = 'nose'; name.dispatchEvent(new Event('change')); })()`);

  // Saved and read back.
  await browser.key('s');
  const rows = (await saved('landmarks.txt')).split('\n').filter((line) => line && !line.startsWith('#'));
  assert.equal(rows.length, await count());
  const numbers = rows[before].split('#')[0].trim().split(/\s+/).map(Number);
  assert.equal(numbers.length, 6);
  const truth = await browser.evaluate(`['source', 'target'].flatMap((side) =>
    varimap.surfaces[side].side.toFile(varimap.landmarks.items[${before}][side].point))`);
  assert.deepEqual(numbers, truth);
  assert.match(rows[before], /# nose$/);
  await browser.evaluate(`document.getElementById('save-target').click()`);
  const markup = JSON.parse(await saved('target.mrk.json')).markups[0];
  assert.equal(markup.controlPoints[before].label, 'nose');
  assert.deepEqual(markup.controlPoints[before].position, truth.slice(3));
  assert.match(await browser.evaluate(`document.getElementById('command').textContent`), /^varimap map .* --landmarks landmarks\.txt$/);

  // Dragged by the left button alone; what is removed under it is gone, and one that is added has a name of its own.
  const placed = await item(before);
  await browser.evaluate(`(() => {
    const marker = document.querySelector('.marker[data-side=source][data-index="${before}"]');
    marker.dispatchEvent(new PointerEvent('pointerdown', { button: 2, bubbles: true }));
    window.dispatchEvent(new PointerEvent('pointermove', { clientX: ${second[0]}, clientY: ${second[1]} }));
    window.dispatchEvent(new PointerEvent('pointerup'));
    marker.dispatchEvent(new PointerEvent('pointerdown', { button: 0, bubbles: true }));
    window.dispatchEvent(new PointerEvent('pointercancel'));
    window.dispatchEvent(new PointerEvent('pointermove', { clientX: ${second[0]}, clientY: ${second[1]} }));
  })()`);
  assert.deepEqual(await item(before), placed);
  await browser.mouse('mouseMoved', ...third);
  await browser.mouse('mousePressed', ...third, 1);
  await browser.mouse('mouseMoved', ...second, 1);
  await browser.key('Delete');
  await browser.mouse('mouseMoved', ...third, 1);
  await browser.mouse('mouseReleased', ...third);
  assert.equal(await count(), before + 1);

  // Layers, themes, the report.
  for (const key of ['1', '2', '3', '4', '5', '6', ...(await browser.evaluate('Boolean(varimap.data.texture)') ? ['7'] : [])]) {
    await browser.key(key);
    assert.equal(await browser.evaluate(`document.querySelector('#layers [aria-pressed=true]').title`), key);
    await picture(`layer-${key}`);
  }
  await browser.key('1');
  await compareCandidates();
  await browser.key('d');
  await browser.key('r');
  assert.equal(await browser.evaluate(`document.getElementById('report').hidden`), false);
  await picture('dark');
  await browser.key('ArrowLeft');

  assert.deepEqual(browser.complaints, []);
  assert.deepEqual(browser.requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
}

try {
  await run();
} finally {
  browser.close();
}
