// Paint that `scumble bake` has made, in three.js.
//
//     const loader = new GLTFLoader();
//     loader.register((parser) => new FinsPlugin(parser));
//     const gltf = await loader.loadAsync('fins.glb');
//
// Engines sort blended objects, and not their triangles. What is drawn is one mesh instead of its coats and fins, with an order of
// all its triangles for the viewer's direction. The file has such orders; where a tool has lost or spoiled them, they are sorted
// here. docs/fins.md says what is in the file.
import { BufferAttribute, DoubleSide, Matrix4, MeshBasicMaterial, Vector3 } from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';

const NO_FADE = [3, 2]; // start and end that leave all of it

export class FinsPlugin {
  constructor(parser) {
    this.parser = parser;
    this.name = 'scumble_paint';
  }

  async afterRoot(gltf) {
    const { json, associations } = this.parser;
    const groups = new Map(); // by parent, and there by number of the mesh: what is drawn of its paint
    for (const scene of gltf.scenes)
      scene.traverse((object) => {
        const place = associations.get(object);
        if (!object.isMesh || place?.primitives === undefined || !isPaint(object)) return;
        const key = `${object.parent.uuid} ${place.meshes}`;
        if (!groups.has(key)) groups.set(key, { mesh: place.meshes, layers: new Map() });
        groups.get(key).layers.set(place.primitives, object);
      });
    const made = new Map(); // by number of the mesh
    for (const { mesh, layers } of groups.values()) {
      const numbers = [...layers.keys()].sort((a, b) => a - b);
      const objects = numbers.map((number) => layers.get(number));
      if (!made.has(mesh)) made.set(mesh, this.merged(json.meshes[mesh].extras?.scumble_orders, numbers, objects));
      const whole = await made.get(mesh);
      if (whole) replace(objects, whole);
    }
  }

  // One geometry of all layers, its orders, and its material; null where there is none.
  async merged(told, numbers, objects) {
    const geometry = mergeGeometries(objects.map((object) => withFade(object)));
    if (!geometry) return null; // their vertices have unlike attributes: they stay as they are
    if (!geometry.index) geometry.setIndex(Array.from({ length: geometry.attributes.position.count }, (_, i) => i));
    geometry.computeBoundingSphere();
    const orders = (await this.toldOrders(told, numbers, geometry)) ?? DIRECTIONS.map((toViewer) => ({ toViewer, index: null }));
    return { geometry, orders, material: finsMaterial(objects[0].material) };
  }

  // Those of the file; null where one of them is not there any more, or is of other triangles than these.
  async toldOrders(told, numbers, geometry) {
    if (!Array.isArray(told?.orders) || told.orders.length === 0 || String(told.primitives) !== String(numbers)) return null;
    const accessors = this.parser.json.accessors ?? [];
    const expected = triangleSums(geometry.index, geometry);
    const orders = [];
    for (const { toViewer, indices } of told.orders) {
      const number = accessors.findIndex((accessor) => typeof indices === 'string' && accessor.name === indices);
      if (number < 0 || !Array.isArray(toViewer)) return null;
      const index = await this.parser.getDependency('accessor', number);
      if (index.count !== geometry.index.count || triangleSums(index, geometry) !== expected) return null;
      orders.push({ toViewer: new Vector3(...toViewer), index });
    }
    return orders;
  }
}

// To the sides and the corners of a cube, as `scumble bake` has them.
const DIRECTIONS = [];
for (const x of [-1, 0, 1])
  for (const y of [-1, 0, 1])
    for (const z of [-1, 0, 1]) {
      const sides = Math.abs(x) + Math.abs(y) + Math.abs(z);
      if (sides === 1 || sides === 3) DIRECTIONS.push(new Vector3(x, y, z).normalize());
    }

// The same for all orders of the same triangles, and for next to nothing else; '' for what is no order of a geometry's vertices.
function triangleSums(index, geometry) {
  const vertices = geometry.attributes.position.count;
  let sum = 0, mixed = 0;
  for (let i = 0; i + 2 < index.count; i += 3) {
    let triangle = 0;
    for (let c = 0; c < 3; ++c) {
      const vertex = index.getX(i + c);
      if (!(vertex < vertices)) return '';
      triangle = (Math.imul(triangle, 31) + vertex + 1) | 0;
    }
    triangle = Math.imul(triangle ^ (triangle >>> 15), 0x2c1b3c6d);
    sum = (sum + triangle) | 0;
    mixed ^= Math.imul(triangle ^ (triangle >>> 13), 0x297a2d39);
  }
  return `${sum} ${mixed}`;
}

// All triangles, from far to near for a viewer in that direction; equals as they come.
function sortedTowards(toViewer, geometry) {
  const { index, attributes: { position } } = geometry;
  const triangles = index.count / 3;
  const nearness = new Float32Array(triangles);
  for (let i = 0; i < index.count; ++i) {
    const vertex = index.getX(i);
    nearness[Math.floor(i / 3)] +=
      position.getX(vertex) * toViewer.x + position.getY(vertex) * toViewer.y + position.getZ(vertex) * toViewer.z;
  }
  const order = Uint32Array.from({ length: triangles }, (_, i) => i).sort((a, b) => nearness[a] - nearness[b] || a - b);
  const sorted = new Uint32Array(index.count);
  order.forEach((triangle, i) => {
    for (let c = 0; c < 3; ++c) sorted[3 * i + c] = index.getX(3 * triangle + c);
  });
  return new BufferAttribute(sorted, 1);
}

function isPaint(object) {
  return object.material.userData.scumble_paint !== undefined;
}

// Fade, and whether its back is seen, at each vertex.
function withFade(object) {
  const { fadeStart = NO_FADE[0], fadeEnd = NO_FADE[1] } = object.material.userData.scumble_paint;
  const geometry = object.geometry.clone();
  const count = geometry.attributes.position.count;
  const fade = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) fade.set([fadeStart, fadeEnd, object.material.side === DoubleSide ? 1 : 0], 3 * i);
  geometry.setAttribute('paintFade', new BufferAttribute(fade, 3));
  return geometry;
}

// The first layer becomes all of them, so that it hangs where it hung, with its skeleton and its morph targets' weights.
function replace(objects, { geometry, orders, material }) {
  const mesh = objects[0];
  for (const other of objects.slice(1)) other.removeFromParent();
  mesh.geometry = geometry.clone(); // its index is its own
  mesh.material = material;
  mesh.userData.scumbleOrder = -1; // which one is drawn
  mesh.onBeforeRender = (renderer, scene, camera) => {
    // Both eyes see the same one.
    const viewer = renderer.xr.isPresenting ? renderer.xr.getCamera() : camera;
    const number = nearestOrder(orders, directionTo(viewer, mesh));
    if (number === mesh.userData.scumbleOrder) return;
    mesh.userData.scumbleOrder = number;
    orders[number].index ??= sortedTowards(orders[number].toViewer, geometry);
    mesh.geometry.setIndex(orders[number].index);
  };
}

const toLocal = new Matrix4(), ofBone = new Matrix4();

// Where a mesh at rest is put. Joints place a skinned one, and not its node: the mean of what they do.
function placeOf(mesh, place) {
  if (!mesh.isSkinnedMesh) return place.copy(mesh.matrixWorld);
  const { bones, boneInverses } = mesh.skeleton;
  place.elements.fill(0);
  bones.forEach((bone, i) => {
    ofBone.multiplyMatrices(bone.matrixWorld, boneInverses[i]).multiply(mesh.bindMatrix);
    for (let e = 0; e < 16; ++e) place.elements[e] += ofBone.elements[e] / bones.length;
  });
  return place;
}

// From the middle of the mesh, in its space.
function directionTo(camera, mesh) {
  placeOf(mesh, toLocal).invert();
  const direction = new Vector3();
  if (camera.isOrthographicCamera) return direction.setFromMatrixColumn(camera.matrixWorld, 2).transformDirection(toLocal);
  return direction.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(toLocal).sub(mesh.geometry.boundingSphere.center).normalize();
}

function nearestOrder(orders, direction) {
  let nearest = 0;
  for (let i = 1; i < orders.length; ++i)
    if (orders[i].toViewer.dot(direction) > orders[nearest].toViewer.dot(direction)) nearest = i;
  return nearest;
}

function patched(shader, changes) {
  for (const [from, to] of changes) {
    if (!shader.includes(from)) console.warn(`fins.js: this three has no '${from}' in its shaders; paint is drawn without its fade`);
    shader = shader.replace(from, to);
  }
  return shader;
}

// Unlit paint that fades by how it faces the viewer (docs/fins.md).
export function finsMaterial(from) {
  const material = new MeshBasicMaterial({ map: from.map, color: from.color, transparent: true, depthWrite: false, side: DoubleSide,
    forceSinglePass: true, toneMapped: from.toneMapped }); // in one pass: two would draw all backs first
  material.name = from.name;
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = patched(shader.vertexShader, [
      ['void main() {', 'attribute vec3 paintFade;\nvarying vec3 vPaintFade, vPaintNormal, vToViewer;\nvoid main() {'],
      ['#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )', '#if 1'], // normals, which unlit materials have none of
      ['#include <project_vertex>', `#include <project_vertex>
        vPaintFade = paintFade;
        vPaintNormal = transformedNormal;
        vToViewer = isPerspectiveMatrix(projectionMatrix) ? -mvPosition.xyz : vec3(0.0, 0.0, 1.0);`]]);
    shader.fragmentShader = patched(shader.fragmentShader, [
      ['void main() {', 'varying vec3 vPaintFade, vPaintNormal, vToViewer;\nvoid main() {'],
      ['#include <map_fragment>', `#include <map_fragment>
        if (vPaintFade.z < 0.5 && !gl_FrontFacing) discard;
        float faces = abs(dot(normalize(vPaintNormal), normalize(vToViewer)));
        float paintShows = clamp((1.0 - faces - vPaintFade.x) / (vPaintFade.y - vPaintFade.x), 0.0, 1.0);
        diffuseColor.a *= paintShows * paintShows * (3.0 - 2.0 * paintShows);`]]);
  };
  material.customProgramCacheKey = () => 'scumble_paint';
  return material;
}
