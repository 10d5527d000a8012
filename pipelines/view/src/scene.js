// The two surfaces side by side on one canvas, seen by one camera.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { makeMaterial, showLayer } from './layers.js';
import { Surface, extentOf, placesOf } from './surface.js';

const sides = ['source', 'target'];
const turnStep = Math.PI / 24;
const zoomStep = 1.15;

// Of the ball about the middle of the box that holds the surface, in units of sqrt(area).
function radiusOf({ positions, size }) {
  let most = 0;
  for (let i = 0; i < positions.length; i += 3)
    most = Math.max(most, positions[i] ** 2 + positions[i + 1] ** 2 + positions[i + 2] ** 2);
  return Math.sqrt(most) / size;
}

export class View {
  constructor(canvas, data, onDraw) {
    this.canvas = canvas;
    this.onDraw = onDraw;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // the shader's colours are those to show
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    const extent = extentOf(data.source);
    this.material = makeMaterial((2 * extent[data.pattern[0]]) / data.source.size);
    const turn = new THREE.Matrix4().makeBasis(...[0, 1, 2].map((c) => new THREE.Vector3(...data.turn.map((row) => row[c]))));
    this.surfaces = {
      source: new Surface(data.source, placesOf(data.source, data), this.material, new THREE.Matrix4(), data.texture?.source),
      target: new Surface(data.target, placesOf(data.target, data), this.material, turn, data.texture?.target),
    };
    this.data = data;
    this.comparing = false;
    if (data.texture) this.loadTexture(data.texture.image);
    this.radius = Math.max(...sides.map((side) => radiusOf(data[side])));
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -20, 20);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = true;
    this.controls.addEventListener('change', () => this.draw());
    this.setUp(data.up, extent);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }
  loadTexture(image) {
    const texture = new THREE.TextureLoader().load(image, () => this.draw());
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    this.material.uniforms.image.value = texture;
  }
  // Shows the source and all candidates beside each other, or source and target.
  compare(on) {
    this.comparing = on;
    if (on && !this.candidateScenes)
      this.candidateScenes = this.data.candidates.map(({ map }) =>
        this.surfaces.target.sceneWith(placesOf(this.data.target, this.data, map)));
    this.resize();
  }
  get scenes() {
    const { source, target } = this.surfaces;
    return [source.scene, ...(this.comparing ? this.candidateScenes : [target.scene])];
  }
  // Which axis of the source points up; the camera looks at the broadest side.
  setUp(axis, extent = extentOf(this.surfaces.source.side)) {
    this.up = axis;
    const up = new THREE.Matrix4();
    if (axis === 'z') up.makeRotationX(-Math.PI / 2);
    for (const side of sides) this.surfaces[side].setUp(up);
    const deep = axis === 'z' ? 1 : 2;
    const fromFront = extent[deep] <= extent[0];
    this.controls.target.set(0, 0, 0);
    this.camera.position.set(fromFront ? 0.8 : 3, 0.5, fromFront ? 3 : 0.8);
    this.camera.zoom = 1;
    this.controls.update();
    this.draw();
  }
  setLayer(layer) {
    showLayer(this.material, layer);
    for (const side of sides) this.surfaces[side].branches.visible = layer.id === 'flips';
    this.draw();
  }
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    const aspect = width / this.scenes.length / height;
    const half = 1.1 * this.radius * Math.max(1, 1 / aspect);
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.camera.updateProjectionMatrix();
    this.draw();
  }
  draw() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.drawNow();
    });
  }
  drawNow() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.renderer.setScissorTest(true);
    const { scenes } = this;
    const part = width / scenes.length;
    scenes.forEach((scene, i) => {
      this.renderer.setViewport(i * part, 0, part, height);
      this.renderer.setScissor(i * part, 0, part, height);
      this.renderer.render(scene, this.camera);
    });
    this.onDraw();
  }
  // Which side's half a point of the canvas is in, and the ray behind it.
  rayAt(x, y) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const side = x < width / 2 ? 'source' : 'target';
    const left = side === 'source' ? 0 : width / 2;
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((2 * (x - left)) / (width / 2) - 1, 1 - (2 * y) / height), this.camera);
    return { side, ray: caster.ray };
  }
  hitAt(x, y, onlySide = null) {
    const { side, ray } = this.rayAt(x, y);
    if (this.comparing) return { side, hit: null };
    if (onlySide && side !== onlySide) return { side, hit: null };
    return { side, hit: this.surfaces[side].hit(ray) };
  }
  // The canvas's point where a point of a surface is drawn, and whether something hides it.
  project(side, point) {
    const place = this.surfaces[side].toScene(point);
    const towards = this.camera.getWorldDirection(new THREE.Vector3()).negate();
    const ray = new THREE.Ray(place.clone().addScaledVector(towards, 0.02), towards);
    const seen = place.project(this.camera);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const left = side === 'source' ? 0 : width / 2;
    return {
      x: left + ((seen.x + 1) / 2) * (width / 2),
      y: ((1 - seen.y) / 2) * height,
      inside: !this.comparing && Math.abs(seen.x) <= 1 && Math.abs(seen.y) <= 1,
      hidden: this.surfaces[side].hit(ray) !== null,
    };
  }
  turn(right, upwards) {
    const place = new THREE.Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    place.theta += right * turnStep;
    place.phi = Math.min(Math.PI - 0.05, Math.max(0.05, place.phi - upwards * turnStep));
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3().setFromSpherical(place));
    this.controls.update();
    this.draw();
  }
  zoom(steps) {
    this.camera.zoom *= zoomStep ** steps;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
  other(side) { return side === 'source' ? 'target' : 'source'; }
  // The point of the other side that belongs to a hit.
  carried(side, hit) { return this.surfaces[side].carry(hit, this.surfaces[this.other(side)]); }
}
