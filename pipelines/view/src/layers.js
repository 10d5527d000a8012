// What the colours show, and their legends. Blue, yellow and lightness tell everything apart, which holds for
// deuteranopia; stripes tell one half of the source from the other.
import * as THREE from 'three';

const ramps = {
  place: ['#00224e', '#3b496c', '#7c7b78', '#bcaf6f', '#fee838'], // cividis
  area: ['#08519c', '#6baed6', '#f7f7f7', '#fd8d3c', '#a63603'],
  angle: ['#fcfbfd', '#cbc9e2', '#9e9ac8', '#756bb1', '#3f007d'],
  wayBack: ['#f7fcfd', '#99d8c9', '#41ae76', '#006d2c', '#001b0c'],
};

const layers = [
  {
    id: 'place', name: 'Pattern', key: '1', ramp: ramps.place, ticks: ['one end', 'the other end'],
    text: 'Colour: place along the source, carried to the target. Checks: equal cells of the source, '
      + 'faint on one half of it, such as the lower. Stripes: on one half, such as the left.',
  },
  {
    id: 'area', name: 'Area', key: '2', ramp: ramps.area, ticks: ['¼ ×', '½ ×', 'kept', '2 ×', '4 ×'],
    text: 'Area of each triangle’s image by its own, both surfaces of one area.',
  },
  {
    id: 'angle', name: 'Angles', key: '3', ramp: ramps.angle, ticks: ['kept', '1.4', '2', '2.8', '4 or more'],
    text: 'Conformal distortion of each triangle: how much longer than wide a small circle becomes.',
  },
  {
    id: 'flips', name: 'Flips', key: '4', ramp: null,
    text: 'Black and magenta: triangles whose image is reversed or collapsed. Dark grey: no image. '
      + 'Black dots with a yellow middle: branch points, round which the map winds more than once.',
  },
  {
    id: 'wayBack', name: 'Confidence', key: '5', ramp: ramps.wayBack, ticks: ['0', '', '.025', '', '.05 or more'],
    text: 'How far from itself a point comes back, there and back again, in units of sqrt(area): light places agree in '
      + 'both directions, dark ones are not to be trusted.',
  },
  { id: 'plain', name: 'Shape', key: '6', ramp: null, text: 'The surfaces as they are.' },
  {
    id: 'texture', name: 'Texture', key: '7', ramp: null,
    text: 'The texture of the source, carried to the target. A triangle across a seam is drawn as on one side of it: '
      + 'varimap transfer --texture cuts there.',
  },
];
// Layers by what the shader calls them; each page has those it has data for.
export const layersFor = (data) => layers.filter(({ id }) => id !== 'texture' || data.texture);
const numbers = { place: 0, area: 1, angle: 2, flips: 3, wayBack: 4, plain: 5, texture: 6 };

const vertexShader = `
  attribute vec3 place;
  attribute vec3 measures;
  attribute vec3 carried;
  varying vec3 vPlace;
  varying vec3 vMeasures;
  varying vec3 vCarried;
  varying vec3 vNormal;
  void main() {
    vPlace = place;
    vMeasures = measures;
    vCarried = carried;
    vNormal = normalMatrix * normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const fragmentShader = `
  uniform int layer;
  uniform vec3 stops[5];
  uniform float cell;
  uniform float reach;
  uniform sampler2D image;
  varying vec3 vPlace;
  varying vec3 vMeasures;
  varying vec3 vCarried;
  varying vec3 vNormal;
  vec3 ramp(float t) {
    float s = clamp(t, 0.0, 1.0) * 4.0;
    vec3 colour = stops[0];
    for (int i = 1; i < 5; i++) colour = mix(colour, stops[i], clamp(s - float(i - 1), 0.0, 1.0));
    return colour;
  }
  vec3 pattern() {
    vec3 colour = ramp(vPlace.x / reach + 0.5);
    vec3 cells = floor(vPlace / cell + vec3(0.5, 0.37, 0.43));
    float dark = mod(cells.x + cells.y + cells.z, 2.0);
    colour = mix(colour, dark > 0.5 ? vec3(0.0) : vec3(1.0), vPlace.y > 0.0 ? 0.34 : 0.12);
    bool striped = vPlace.z > 0.0;
    if (striped && fract((vPlace.x + vPlace.y) / cell * 2.0) < 0.3) colour = mix(colour, vec3(dark), 0.6);
    return colour;
  }
  void main() {
    // carried: how far a point comes back, from 0 to 1, -1: nowhere; texture coordinates.
    // measures: log2 of the area's change, log2 of the conformal distortion; 0 fine, 1 flipped, 2 no image
    vec3 colour = vec3(0.78);
    if (layer == 0) colour = pattern();
    if (layer == 1) colour = ramp(vMeasures.x / 4.0 + 0.5);
    if (layer == 2) colour = ramp(vMeasures.y / 2.0);
    if (layer == 3 && vMeasures.z > 0.5)
      colour = fract((gl_FragCoord.x + gl_FragCoord.y) / 8.0) < 0.35 ? vec3(0.0) : vec3(1.0, 0.0, 0.65);
    if (layer == 4) colour = vCarried.x < 0.0 ? vec3(0.33) : ramp(vCarried.x);
    if (layer == 6) colour = texture2D(image, vCarried.yz).rgb;
    if (layer < 4 && vMeasures.z > 1.5) colour = vec3(0.33);
    vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    float light = 0.6 + 0.36 * max(0.0, dot(n, normalize(vec3(-0.4, 0.6, 0.7)))) + 0.14 * max(0.0, n.z);
    gl_FragColor = vec4(colour * light, 1.0);
  }`;

// reach: length of the source along its longest axis, in units of sqrt(area).
export function makeMaterial(reach) {
  return new THREE.ShaderMaterial({
    uniforms: {
      layer: { value: 0 },
      stops: { value: ramps.place.map(toVector) },
      cell: { value: 0.09 },
      reach: { value: reach },
      image: { value: null },
    },
    vertexShader,
    fragmentShader,
    side: THREE.DoubleSide,
    polygonOffset: true, // dots on the surface lie before it
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 4,
  });
}

function toVector(hex) {
  return new THREE.Vector3(...[1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255));
}

export function showLayer(material, layer) {
  material.uniforms.layer.value = numbers[layer.id];
  if (layer.ramp) material.uniforms.stops.value = layer.ramp.map(toVector);
}

export function drawLegend(element, { name, text, ramp, ticks }) {
  element.replaceChildren();
  const add = (tag, content, className) => {
    const child = document.createElement(tag);
    child.textContent = content;
    if (className) child.className = className;
    element.append(child);
    return child;
  };
  add('b', name);
  if (ramp) {
    add('div', '', 'bar').style.background = `linear-gradient(to right, ${ramp.join(',')})`;
    const row = add('div', '', 'ticks');
    for (const tick of ticks) row.append(Object.assign(document.createElement('span'), { textContent: tick }));
  }
  add('div', text);
}
