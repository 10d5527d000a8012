// Reads what varimap-view wrote into the page: the description as JSON, and all arrays, deflated, as base64.

const arrayTypes = { Uint8Array, Uint16Array, Int32Array, Float32Array };
const steps = 65535;

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

function mapOf(json, array) {
  return { face: array(json.face), shares: array(json.barycentric) };
}

// One mesh, its map and distortions. Positions are those of the file, relative to the middle of its box.
class Side {
  constructor(json, buffer) {
    const array = ({ at, count, type }) => new arrayTypes[type](buffer, at, count);
    Object.assign(this, { file: json.file, name: json.name, axes: json.axes, size: json.size, inFile: json.vertices });
    this.middle = json.low.map((low) => low + json.extent / 2);
    this.positions = Float32Array.from(array(json.position), (step) => (step / steps - 0.5) * json.extent);
    this.corners = Uint32Array.from(array(json.corner));
    for (let i = 1; i < this.corners.length; i++) this.corners[i] += this.corners[i - 1];
    this.map = mapOf(json.map, array);
    this.area = array(json.distortion.area);
    this.angle = array(json.distortion.angle);
    this.flipped = array(json.distortion.flipped);
    this.wayBack = array(json.way_back);
    this.branches = array(json.branches);
  }
  get faceCount() { return this.corners.length / 3; }
  get vertexCount() { return this.positions.length / 3; }
  position(v) { return [0, 1, 2].map((axis) => this.positions[3 * v + axis]); }
  // Coordinates of the mesh file, to the digits that are known.
  toFile(point) { return point.map((x, axis) => Number((x + this.middle[axis]).toPrecision(7))); }
  fromFile(point) { return point.map((x, axis) => x - this.middle[axis]); }
  // Where vertex v lies on the other side; none: null.
  image(v, other, map = this.map) {
    const f = map.face[v];
    if (f < 0) return null;
    const b = [map.shares[2 * v] / steps, map.shares[2 * v + 1] / steps];
    b.push(1 - b[0] - b[1]);
    return other.mixed(f, b);
  }
  mixed(face, shares) {
    const point = [0, 0, 0];
    for (let k = 0; k < 3; k++) {
      const v = this.corners[3 * face + k];
      for (let axis = 0; axis < 3; axis++) point[axis] += shares[k] * this.positions[3 * v + axis];
    }
    return point;
  }
}

export async function readData(document) {
  const json = JSON.parse(document.getElementById('data').textContent);
  const buffer = await inflated(document.getElementById('arrays').textContent.trim());
  document.getElementById('arrays').remove();
  const array = ({ at, count, type }) => new arrayTypes[type](buffer, at, count);
  const { texture } = json;
  return {
    source: new Side(json.source, buffer),
    target: new Side(json.target, buffer),
    turn: json.turn,
    pattern: json.pattern,
    up: json.up,
    landmarks: json.landmarks,
    report: json.report,
    texture: texture && { image: texture.image, source: array(texture.source), target: array(texture.target) },
    candidates: json.candidates.map(({ relation, map }) => ({ relation, map: mapOf(map, array) })),
  };
}
