// SPDX-License-Identifier: Apache-2.0
// Holds the mask of web/three's example to rays that three.js casts at the same scene.
import * as THREE from 'three/webgpu';

const RAYS = 6; // to the rim of a light, and one to its middle
const CLEAR = 0.02; // m: rays begin so far off the surface

/** Directions from a point to points of a light, and how far they go. */
function raysTo(light, point) {
  const from = new THREE.Vector3().setFromMatrixPosition(light.matrixWorld);
  let axis;
  let far;
  let spread;
  if (light.isDirectionalLight) {
    axis = from.sub(new THREE.Vector3().setFromMatrixPosition(light.target.matrixWorld)).normalize();
    [far, spread] = [1000, Math.tan(0.5 * 0.53 * Math.PI / 180)];
  } else {
    axis = from.sub(point);
    far = axis.length() - light.userData.gnomon.radius;
    spread = light.userData.gnomon.radius / axis.length();
    axis.normalize();
  }
  const across = new THREE.Vector3(0.3, 0.5, 0.8).cross(axis).normalize();
  const other = axis.clone().cross(across);
  const rim = Array.from({ length: RAYS }, (_, i) => axis.clone().addScaledVector(across, 1.3 * spread * Math.cos(i)).addScaledVector(other, 1.3 * spread * Math.sin(i)).normalize());
  return { axis, far, directions: [axis, ...rim] };
}

/** Points of a grid over the picture: where the surface is all in a light or all in shadow, and what the mask says there. */
export function compare({ camera, court, shadows, texels, width, height, light, step }) {
  const place = shadows.plan.lights[[court.sun, court.spot, court.lamp].filter((one) => one.visible).indexOf(light)];
  const channels = shadows.mask.format === 'r8unorm' ? 1 : 4;
  const meshes = [];
  const leaves = [];
  court.scene.traverseVisible((object) => object.isMesh && (object.material.alphaTest > 0 ? leaves : meshes).push(object));
  const ray = new THREE.Raycaster();
  const found = { lit: 0, shadowed: 0, wrong: [] };
  for (let y = step >> 1; y < height; y += step) {
    for (let x = step >> 1; x < width; x += step) {
      ray.far = Infinity;
      ray.setFromCamera(new THREE.Vector2(2 * (x + 0.5) / width - 1, 1 - 2 * (y + 0.5) / height), camera);
      const [hit] = ray.intersectObjects(meshes, false);
      const before = ray.intersectObjects(leaves, false);
      if (!hit || before.some((one) => one.distance < hit.distance)) {
        continue;
      }
      const matrix = hit.object.matrixWorld.clone();
      if (hit.instanceId !== undefined) {
        const own = new THREE.Matrix4();
        hit.object.getMatrixAt(hit.instanceId, own);
        matrix.multiply(own);
      }
      const normal = hit.face.normal.clone().transformDirection(matrix);
      const { axis, far, directions } = raysTo(light, hit.point);
      const cosine = normal.dot(axis);
      const outside = light.isSpotLight && -axis.dot(new THREE.Vector3().subVectors(light.target.position, light.position).normalize()) < Math.cos(light.angle) + 0.01;
      if (cosine < 0.15 || outside || (light.distance > 0 && far > 0.95 * light.distance)) {
        continue; // another test's: surfaces that face away, and beyond a lamp's reach
      }
      const start = hit.point.clone().addScaledVector(normal, CLEAR);
      const hits = directions.map((direction) => {
        ray.set(start, direction);
        ray.far = far;
        return [ray.intersectObjects(meshes, false).length > 0, ray.intersectObjects(leaves, false).length > 0];
      });
      const blocked = hits.filter(([solid]) => solid).length;
      if (hits.some(([, leaf]) => leaf) || (blocked > 0 && blocked < hits.length)) {
        continue;
      }
      const expected = blocked > 0 ? 0 : 1;
      const said = texels[channels * ((place.maskLayer * height + y) * width + x) + place.maskChannel] / 255;
      found[expected === 1 ? 'lit' : 'shadowed'] += 1;
      if (Math.abs(said - expected) > 0.3) {
        found.wrong.push([x, y, expected, said]);
      }
    }
  }
  return found;
}
