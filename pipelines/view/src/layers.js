// What the colours show, and their legends. Blue, yellow and lightness tell everything apart, which holds for
// deuteranopia; stripes tell one half of the source from the other.
import * as THREE from 'three';

const ramps = {
  place: ['#00224e', '#3b496c', '#7c7b78', '#bcaf6f', '#fee838'], // cividis
  area: ['#08519c', '#6baed6', '#f7f7f7', '#fd8d3c', '#a63603'],
  angle: ['#fcfbfd', '#cbc9e2', '#9e9ac8', '#756bb1', '#3f007d'],
};

export const layers = [
  {
    id: 'place', name: 'Pattern', key: '1', ramp: ramps.place, ticks: ['one end', 'the other end'],
    text: 'Colour: place along the source’s longest axis, carried to the target. Checks: equal cells of the source. '
      + 'Stripes: one half of its shortest axis, such as the left.',
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
    text: 'Black and magenta: triangles whose image is reversed or collapsed. Dark grey: no image.',
  },
  { id: 'plain', name: 'Shape', key: '5', ramp: null, text: 'The surfaces as they are.' },
];

const vertexShader = `
  attribute vec3 place;
  attribute vec3 measures;
  varying vec3 vPlace;
  varying vec3 vMeasures;
  varying vec3 vNormal;
  void main() {
    vPlace = place;
    vMeasures = measures;
    vNormal = normalMatrix * normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const fragmentShader = `
  uniform int layer;
  uniform vec3 stops[5];
  uniform float cell;
  uniform float reach;
  varying vec3 vPlace;
  varying vec3 vMeasures;
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
    colour = mix(colour, dark > 0.5 ? vec3(0.0) : vec3(1.0), 0.22);
    bool striped = vPlace.z > 0.0;
    if (striped && fract((vPlace.x + vPlace.y) / cell * 2.0) < 0.3) colour = mix(colour, vec3(dark), 0.6);
    return colour;
  }
  void main() {
    // measures: log2 of the area's change, log2 of the conformal distortion; 0 fine, 1 flipped, 2 no image
    vec3 colour = vec3(0.78);
    if (layer == 0) colour = pattern();
    if (layer == 1) colour = ramp(vMeasures.x / 4.0 + 0.5);
    if (layer == 2) colour = ramp(vMeasures.y / 2.0);
    if (layer == 3 && vMeasures.z > 0.5)
      colour = fract((gl_FragCoord.x + gl_FragCoord.y) / 8.0) < 0.35 ? vec3(0.0) : vec3(1.0, 0.0, 0.65);
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
    },
    vertexShader,
    fragmentShader,
    side: THREE.DoubleSide,
  });
}

function toVector(hex) {
  return new THREE.Vector3(...[1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255));
}

export function showLayer(material, index) {
  material.uniforms.layer.value = index;
  if (layers[index].ramp) material.uniforms.stops.value = layers[index].ramp.map(toVector);
}

export function drawLegend(element, index) {
  const { name, text, ramp, ticks } = layers[index];
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
