// Joins what the page holds: the surfaces, the layers, the landmarks and the report.
import { readData } from './data.js';
import { Landmarks, download, nextCommand } from './landmarks.js';
import { drawLegend, layersFor } from './layers.js';
import { drawReport } from './report.js';
import { View } from './scene.js';

const sides = ['source', 'target'];
const byId = (id) => document.getElementById(id);
const started = performance.now();
const notDragged = 4; // pixels that a click may move

function element(tag, className, text = '') {
  return Object.assign(document.createElement(tag), { className, textContent: text });
}

class Page {
  constructor(data) {
    this.data = data;
    this.layers = layersFor(data);
    this.picking = false;
    this.active = 'source';
    this.layer = 0;
    this.landmarks = new Landmarks(() => this.showLandmarks());
    this.dots = { source: element('div', 'cursor'), target: element('div', 'cursor') };
    this.cross = element('div', 'cross');
    byId('markers').append(this.dots.source, this.dots.target, this.cross);
    this.cross.hidden = true;
    this.view = new View(byId('canvas'), data, () => this.placeMarkers());
    this.surfaces = this.view.surfaces;
    this.connect();
    this.describe();
    this.setLayer(0);
    this.showPoint(null);
    this.loadLandmarks();
  }

  describe() {
    for (const side of sides) {
      const { name, vertexCount, inFile } = this.data[side];
      const caption = byId(`caption-${side}`);
      const number = (count) => count.toLocaleString('en');
      const shown = vertexCount < inFile ? `, ${number(vertexCount)} of them shown` : '';
      caption.append(element('b', '', side), ` ${name}, ${number(inFile)} vertices${shown}`);
    }
    document.title = `${this.data.source.name} onto ${this.data.target.name} – varimap`;
    byId('title').textContent = `${this.data.source.name} → ${this.data.target.name}`;
    drawReport(byId('report'), this.data.report);
    if (this.data.report) byId('report-button').textContent = `Report: ${this.data.report.verdict}`;
    this.describeCandidates();
    byId('command').textContent = nextCommand(this.data.report, this.surfaces);
  }

  loadLandmarks() {
    for (const { name, source, target } of this.data.landmarks) {
      const at = (side, point) => this.surfaces[side].closest(this.data[side].fromFile(point));
      this.landmarks.items.push({ name, suggested: null, source: at('source', source), target: at('target', target) });
    }
    this.showLandmarks();
  }

  // --- What is shown -------------------------------------------------------------------------------------------

  setLayer(index) {
    this.layer = index;
    this.view.setLayer(this.layers[index]);
    drawLegend(byId('legend'), this.layers[index]);
    for (const [i, button] of [...byId('layers').children].entries()) button.setAttribute('aria-pressed', i === index);
  }

  // The maps that the choice was among, beside each other; how to continue another.
  setComparing(on) {
    this.view.compare(on);
    byId('compare').setAttribute('aria-pressed', on);
    byId('candidates').hidden = !on;
    for (const side of sides) byId(`caption-${side}`).hidden = on;
    if (on) this.setLayer(0);
    this.showPoint(null);
    if (on) byId('status').textContent = 'Do the colours arrive where they belong? Continue another by --candidate';
  }

  describeCandidates() {
    byId('compare').hidden = this.data.candidates.length === 0;
    const caption = (title, text) => {
      const label = element('div', '');
      label.append(element('b', '', title), ` ${text}`);
      return label;
    };
    byId('candidates').replaceChildren(caption('source', this.data.source.name),
      ...this.data.candidates.map(({ relation }, k) => caption(`candidate ${k + 1}`, `${relation}: --candidate ${k + 1}`)));
  }

  setTheme(dark) {
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    byId('theme').textContent = dark ? 'Light' : 'Dark';
  }

  setPicking(on) {
    this.picking = on;
    byId('pick').setAttribute('aria-pressed', on);
    byId('hint').textContent = on
      ? 'Click a point on either side; its partner is suggested (dashed). Drag either, or click the right place, to correct it.'
      : 'Numbers are pairs. Drag one to move it; press “Pick landmarks” (P) to add some.';
  }

  setReport(on) {
    byId('report').hidden = !on;
    byId('report-button').setAttribute('aria-expanded', on);
  }

  // Shows where the point under the cursor lies on the other side.
  showPoint(side, hit) {
    const other = side && this.view.other(side);
    const image = hit ? this.view.carried(side, hit) : null;
    this.shown = hit ? { [side]: hit, [other]: image } : {};
    this.say(hit, side, image, other);
    this.placeMarkers();
  }

  say(hit, side, image, other) {
    const words = ({ point }, of) => `${of} ${this.data[of].toFile(point).join(', ')}`;
    byId('status').textContent = !hit ? 'Drag to turn, wheel to zoom, right drag to shift'
      : `${words(hit, side)} → ${image ? words(image, other) : 'no image'}`;
  }

  placeMarkers() {
    for (const side of sides) {
      const hit = this.shown?.[side];
      this.dots[side].hidden = !hit;
      if (hit) this.place(this.dots[side], side, hit.point);
    }
    for (const marker of document.querySelectorAll('.marker'))
      this.place(marker, marker.dataset.side, this.landmarks.items[marker.dataset.index][marker.dataset.side].point);
    const { clientWidth: width, clientHeight: height } = byId('canvas');
    this.cross.style.left = `${((this.active === 'source' ? 1 : 3) * width) / 4}px`;
    this.cross.style.top = `${height / 2}px`;
  }

  place(marker, side, point) {
    const { x, y, inside, hidden } = this.view.project(side, point);
    marker.style.left = `${x}px`;
    marker.style.top = `${y}px`;
    marker.style.visibility = inside ? '' : 'hidden';
    marker.classList.toggle('hidden', hidden);
  }

  showLandmarks() {
    for (const marker of document.querySelectorAll('.marker')) marker.remove();
    byId('list').replaceChildren(...this.landmarks.items.map((item, index) => this.row(item, index)));
    this.landmarks.items.forEach((item, index) => {
      for (const side of sides) if (item[side]) this.addMarker(item, index, side);
    });
    for (const id of ['save-pairs', 'save-source', 'save-target'])
      byId(id).disabled = this.landmarks.complete.length === 0;
    this.placeMarkers();
  }

  row(item, index) {
    const row = element('li', index === this.landmarks.selected ? 'selected' : '');
    const number = element('button', '', String(index + 1));
    number.title = 'Select';
    number.addEventListener('click', () => this.landmarks.select(index));
    const name = Object.assign(element('input', ''), { value: item.name });
    name.setAttribute('aria-label', `Name of landmark ${index + 1}`);
    name.addEventListener('change', () => this.landmarks.rename(index, name.value));
    const remove = element('button', '', '×');
    remove.setAttribute('aria-label', `Remove landmark ${index + 1}`);
    remove.addEventListener('click', () => this.landmarks.remove(index));
    row.append(number, name, element('span', 'sides', item.suggested ? `${item.suggested} suggested` : ''), remove);
    return row;
  }

  addMarker(item, index, side) {
    const classes = ['marker', item.suggested === side ? 'suggested' : '', index === this.landmarks.selected ? 'selected' : ''];
    const marker = element('div', classes.join(' '), String(index + 1));
    Object.assign(marker.dataset, { side, index });
    marker.title = `${item.name}, ${side}`;
    marker.addEventListener('pointerdown', (event) => this.drag(event, index, side));
    byId('markers').append(marker);
  }

  // --- What is done --------------------------------------------------------------------------------------------

  drag(event, index, side) {
    if (event.button !== 0) return;
    event.preventDefault();
    this.landmarks.selected = index;
    const item = this.landmarks.items[index];
    const follow = (move) => {
      const { hit } = this.view.hitAt(...this.toCanvas(move), side);
      const now = this.landmarks.items.indexOf(item); // it may have been removed meanwhile
      if (hit && now >= 0) this.landmarks.move(now, side, hit);
    };
    const dragging = new AbortController();
    const stop = () => {
      dragging.abort();
      this.showLandmarks();
    };
    const { signal } = dragging;
    window.addEventListener('pointermove', follow, { signal });
    for (const type of ['pointerup', 'pointercancel']) window.addEventListener(type, stop, { signal });
  }

  // A point picked on one side: the suggested place of the selected landmark there, or a new landmark.
  pick(side, hit) {
    const { items, selected } = this.landmarks;
    if (selected >= 0 && items[selected].suggested === side) return this.landmarks.move(selected, side, hit);
    const other = this.view.other(side);
    const image = this.view.carried(side, hit);
    this.landmarks.add({ [side]: hit, [other]: image }, image ? other : null);
    byId('status').textContent = `landmark ${this.landmarks.items.length} on the ${side}; its partner on the ${other} is suggested`;
  }

  toCanvas(event) {
    const box = byId('canvas').getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  connect() {
    this.layers.forEach((layer, index) => {
      const button = element('button', '', layer.name);
      button.title = layer.key;
      button.addEventListener('click', () => this.setLayer(index));
      byId('layers').append(button);
    });
    byId('pick').addEventListener('click', () => this.setPicking(!this.picking));
    byId('up').addEventListener('click', () => this.turnUp());
    byId('theme').addEventListener('click', () => this.setTheme(document.documentElement.dataset.theme !== 'dark'));
    byId('report-button').addEventListener('click', () => this.setReport(byId('report').hidden));
    byId('compare').addEventListener('click', () => this.setComparing(!this.view.comparing));
    byId('save-pairs').addEventListener('click', () => this.save());
    for (const side of sides)
      byId(`save-${side}`).addEventListener('click', () =>
        download(`${side}.mrk.json`, this.landmarks.markupsText(side, this.surfaces[side])));
    byId('copy').addEventListener('click', () => navigator.clipboard?.writeText(byId('command').textContent));
    this.connectCanvas();
    document.addEventListener('keydown', (event) => this.onKey(event));
    byId('up').textContent = `Up: ${this.view.up}`;
    this.setPicking(false);
    this.setTheme(window.matchMedia('(prefers-color-scheme: dark)').matches);
  }

  connectCanvas() {
    const canvas = byId('canvas');
    let pressed = null;
    canvas.addEventListener('pointerdown', (event) => { pressed = this.toCanvas(event); });
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons !== 0) return;
      this.cross.hidden = true;
      const { side, hit } = this.view.hitAt(...this.toCanvas(event));
      this.showPoint(side, hit);
    });
    canvas.addEventListener('pointerleave', () => this.showPoint(null));
    canvas.addEventListener('pointerup', (event) => {
      const [x, y] = this.toCanvas(event);
      const still = pressed && Math.hypot(x - pressed[0], y - pressed[1]) < notDragged;
      const { side, hit } = this.view.hitAt(x, y);
      if (still && this.picking && hit && event.button === 0) this.pick(side, hit);
    });
  }

  turnUp() {
    this.view.setUp(this.view.up === 'y' ? 'z' : 'y');
    byId('up').textContent = `Up: ${this.view.up}`;
  }

  save() { download('landmarks.txt', this.landmarks.pairsText(this.surfaces)); }

  onKey(event) {
    if (event.target.tagName === 'INPUT' || event.ctrlKey || event.metaKey || event.altKey) return;
    const layer = this.layers.findIndex(({ key }) => key === event.key);
    if (layer >= 0) return this.setLayer(layer);
    const action = this.keys[event.key] ?? (event.target === byId('canvas') ? this.canvasKeys[event.key] : undefined);
    if (!action) return;
    event.preventDefault();
    action();
  }

  keys = {
    p: () => this.setPicking(!this.picking),
    u: () => this.turnUp(),
    c: () => this.data.candidates.length > 0 && this.setComparing(!this.view.comparing),
    d: () => byId('theme').click(),
    r: () => byId('report-button').click(),
    s: () => this.landmarks.complete.length > 0 && this.save(),
    Delete: () => this.landmarks.selected >= 0 && this.landmarks.remove(this.landmarks.selected),
  };

  canvasKeys = {
    ArrowLeft: () => this.turnByKey(-1, 0),
    ArrowRight: () => this.turnByKey(1, 0),
    ArrowUp: () => this.turnByKey(0, 1),
    ArrowDown: () => this.turnByKey(0, -1),
    '+': () => this.view.zoom(1),
    '-': () => this.view.zoom(-1),
    ',': () => this.activate('source'),
    '.': () => this.activate('target'),
    ' ': () => this.pickByKey(),
  };

  turnByKey(right, upwards) {
    this.view.turn(right, upwards);
    this.activate(this.active);
  }

  // The cross in the middle of a side takes the cursor's place.
  activate(side) {
    this.active = side;
    this.cross.hidden = false;
    this.view.drawNow();
    this.showPoint(side, this.underCross());
  }

  underCross() {
    const { clientWidth: width, clientHeight: height } = byId('canvas');
    return this.view.hitAt(((this.active === 'source' ? 1 : 3) * width) / 4, height / 2).hit;
  }

  pickByKey() {
    this.cross.hidden = false;
    const hit = this.underCross();
    if (hit) this.pick(this.active, hit);
  }
}

readData(document).then((data) => {
  const page = new Page(data);
  requestAnimationFrame(() => requestAnimationFrame(() => {
    document.documentElement.dataset.ready = String(Math.round(performance.now() - started));
    window.varimap = page;
  }));
}).catch((error) => {
  document.body.prepend(element('p', 'warning', `This page cannot be shown: ${error.message}`));
  throw error;
});
