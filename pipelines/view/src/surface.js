// One surface on the screen: its triangles, and where rays and points meet it.
import * as THREE from 'three';
import { MeshBVH } from 'three-mesh-bvh';

const noMeasure = 0;
const log2Of = (step) => (step === noMeasure ? 0 : (step - 128) / 32);

// Unit normals at vertices, of faces weighted by their area.
function vertexNormals({ positions, corners }) {
  const normals = new Float32Array(positions.length);
  const edge = [[0, 0, 0], [0, 0, 0]];
  for (let c = 0; c < corners.length; c += 3) {
    for (let k = 0; k < 2; k++) {
      for (let axis = 0; axis < 3; axis++)
        edge[k][axis] = positions[3 * corners[c + k + 1] + axis] - positions[3 * corners[c] + axis];
    }
    const [a, b] = edge;
    const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    for (let k = 0; k < 3; k++)
      for (let axis = 0; axis < 3; axis++) normals[3 * corners[c + k] + axis] += n[axis];
  }
  return normals;
}

// An array of three numbers for every corner of every face, from those of its vertex.
function atCorners(corners, ofVertex) {
  const values = new Float32Array(3 * corners.length);
  for (let c = 0; c < corners.length; c++)
    for (let axis = 0; axis < 3; axis++) values[3 * c + axis] = ofVertex[3 * corners[c] + axis];
  return values;
}

function measuresOf(side) {
  const measures = new Float32Array(9 * side.faceCount);
  for (let f = 0; f < side.faceCount; f++) {
    const state = side.area[f] === noMeasure ? 2 : side.flipped[f];
    for (let k = 0; k < 3; k++)
      measures.set([log2Of(side.area[f]), log2Of(side.angle[f]), state], 9 * f + 3 * k);
  }
  return measures;
}

// For every corner: how far it comes back, from 0 to 1, or -1; and its texture coordinates.
function carriedOf(side, uv) {
  const values = new Float32Array(9 * side.faceCount);
  for (let c = 0; c < side.corners.length; c++) {
    const step = side.wayBack[side.corners[c]];
    values[3 * c] = step === noMeasure ? -1 : (step - 1) / 254;
    if (uv) values.set(uv.subarray(2 * c, 2 * c + 2), 3 * c + 1);
  }
  return values;
}

// Black dots with a yellow middle, at vertices.
function dotsAt(side, vertices) {
  const canvas = Object.assign(document.createElement('canvas'), { width: 32, height: 32 });
  const pen = canvas.getContext('2d');
  for (const [colour, radius] of [['#000', 15], ['#fee838', 8]]) {
    pen.fillStyle = colour;
    pen.beginPath();
    pen.arc(16, 16, radius, 0, 2 * Math.PI);
    pen.fill();
  }
  const geometry = new THREE.BufferGeometry();
  const positions = Float32Array.from(Array.from(vertices).flatMap((v) => side.position(v)));
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  const map = new THREE.CanvasTexture(canvas);
  const material = new THREE.PointsMaterial({ map, size: 12, sizeAttenuation: false, alphaTest: 0.5 });
  return new THREE.Points(geometry, material);
}

export class Surface {
  // places: of every vertex, where it lies on the source (placesOf); uv: texture coordinates of every corner, or none.
  constructor(side, places, material, turn, uv) {
    this.side = side;
    const geometry = new THREE.BufferGeometry();
    const add = (name, values) => geometry.setAttribute(name, new THREE.BufferAttribute(values, 3));
    add('position', atCorners(side.corners, side.positions));
    add('normal', atCorners(side.corners, vertexNormals(side)));
    add('place', atCorners(side.corners, places));
    add('measures', measuresOf(side));
    add('carried', carriedOf(side, uv));
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.matrixAutoUpdate = false;
    this.turn = turn;
    this.scene = new THREE.Scene();
    this.branches = dotsAt(side, side.branches);
    this.branches.matrixAutoUpdate = false;
    this.scene.add(this.mesh, this.branches);
    this.setUp(new THREE.Matrix4());
  }
  // The same surface with other places, for a candidate.
  sceneWith(places) {
    const geometry = this.mesh.geometry.clone();
    geometry.setAttribute('place', new THREE.BufferAttribute(atCorners(this.side.corners, places), 3));
    const mesh = new THREE.Mesh(geometry, this.mesh.material);
    mesh.matrixAutoUpdate = false;
    Object.assign(mesh, { matrix: this.mesh.matrix, matrixWorld: this.mesh.matrixWorld, matrixWorldAutoUpdate: false }); // turns with this one
    const scene = new THREE.Scene();
    scene.add(mesh);
    return scene;
  }
  // Rays need it, the first picture does not: it is made when first asked for.
  get bvh() {
    if (!this.tree) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(this.side.positions, 3));
      geometry.setIndex(new THREE.BufferAttribute(this.side.corners.slice(), 1));
      this.tree = new MeshBVH(geometry, { indirect: true });
    }
    return this.tree;
  }
  setUp(up) {
    this.mesh.matrix.copy(up).multiply(this.turn).scale(new THREE.Vector3().setScalar(1 / this.side.size));
    this.branches.matrix.copy(this.mesh.matrix);
    for (const shown of [this.mesh, this.branches]) shown.updateMatrixWorld(true);
    this.inverse = this.mesh.matrix.clone().invert();
  }
  // Where a ray of the scene meets the surface first: {face, point, shares}, or null.
  hit(ray) {
    const found = this.bvh.raycastFirst(ray.clone().applyMatrix4(this.inverse), THREE.DoubleSide);
    return found ? this.at(found.faceIndex, found.point) : null;
  }
  closest(point) {
    const found = this.bvh.closestPointToPoint(new THREE.Vector3(...point));
    return this.at(found.faceIndex, found.point);
  }
  at(face, point) {
    const corners = [0, 1, 2].map((k) => new THREE.Vector3(...this.side.position(this.side.corners[3 * face + k])));
    const shares = THREE.Triangle.getBarycoord(point, ...corners, new THREE.Vector3());
    return { face, point: point.toArray(), shares: shares ? shares.toArray() : [1, 0, 0] };
  }
  // Where a point of this surface lies on another, through the map: linear between the corners' images.
  carry({ face, shares }, other) {
    const sum = [0, 0, 0];
    for (let k = 0; k < 3; k++) {
      const image = this.side.image(this.side.corners[3 * face + k], other.side);
      if (!image) return null;
      for (let axis = 0; axis < 3; axis++) sum[axis] += shares[k] * image[axis];
    }
    return other.closest(sum);
  }
  toScene(point) { return new THREE.Vector3(...point).applyMatrix4(this.mesh.matrix); }
}

// Where the vertices of a side lie on the source, relative to the middle of its box, by the axes of the pattern (the
// last one from left to right), in units of sqrt(area). `map`: another than the side's own.
export function placesOf(side, { source, pattern }, map = side.map) {
  const places = new Float32Array(side.positions.length);
  for (let v = 0; v < side.vertexCount; v++) {
    const point = side === source ? side.position(v) : side.image(v, source, map) || [0, 0, 0];
    for (let k = 0; k < 3; k++) places[3 * v + k] = point[pattern[k]] / source.size;
  }
  return places;
}

// Half the lengths of a side's box.
export function extentOf(side) {
  return [0, 1, 2].map((axis) => {
    let most = 0;
    for (let i = axis; i < side.positions.length; i += 3) most = Math.max(most, Math.abs(side.positions[i]));
    return most;
  });
}
