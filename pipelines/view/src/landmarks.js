// Pairs of points, one on each surface: the list, and the files it is saved as. No graphics.

const sides = ['source', 'target'];

export class Landmarks {
  constructor(onChange) {
    this.items = [];
    this.selected = -1;
    this.onChange = onChange;
  }
  add(points, suggested = null) {
    let number = 1;
    while (this.items.some(({ name }) => name === `L${number}`)) number++;
    this.items.push({ name: `L${number}`, suggested, ...points });
    this.select(this.items.length - 1);
    return this.items.at(-1);
  }
  select(index) {
    this.selected = index;
    this.onChange();
  }
  move(index, side, hit) {
    const item = this.items[index];
    item[side] = hit;
    if (item.suggested === side) item.suggested = null;
    this.select(index);
  }
  remove(index) {
    this.items.splice(index, 1);
    this.select(Math.min(this.selected, this.items.length - 1));
  }
  rename(index, name) { this.items[index].name = name; }
  get complete() { return this.items.filter((item) => item.source && item.target); }

  // x y z of the source, x y z of the target, in the coordinates of the mesh files.
  pairsText(surfaces) {
    const lines = this.complete.map((item) => {
      const numbers = sides.map((side) => surfaces[side].side.toFile(item[side].point).join(' ')).join('  ');
      return `${numbers}  # ${item.name.replace(/[\r\n]/g, ' ')}\n`;
    });
    return '# source x y z  target x y z\n' + lines.join('');
  }
  // 3D Slicer's markups; names tell which points belong together.
  markupsText(side, surface) {
    const controlPoints = this.complete.map((item, i) => ({
      id: String(i + 1),
      label: item.name,
      position: surface.side.toFile(item[side].point),
      selected: true,
      locked: false,
      visibility: true,
      positionStatus: 'defined',
    }));
    const markup = { type: 'Fiducial', coordinateSystem: surface.side.axes, coordinateUnits: 'mm', controlPoints };
    return JSON.stringify({
      '@schema': 'https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#',
      markups: [markup],
    }, null, 2) + '\n';
  }
}

// Options that speak of the landmarks or the map of before.
const ofBefore = ['--candidate', '--initial-map', '--map-base', '--landmark-space', '--landmark-base'];

// The command that maps again with the saved landmarks, with the options of before.
export function nextCommand(report, surfaces) {
  const quoted = (word) => (/^[\w./=:+,@%-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`);
  const options = (report?.options ?? []).filter(([name]) => !ofBefore.includes(name)).flat();
  return ['varimap', 'map', surfaces.source.side.file, surfaces.target.side.file, '-o', 'out-picked', ...options,
    '--landmarks', 'landmarks.txt'].map(quoted).join(' ');
}

export function download(name, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
