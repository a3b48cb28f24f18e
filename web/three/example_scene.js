// SPDX-License-Identifier: Apache-2.0
// The example's scene: a court with columns, a tree and a fountain, under a sun and two lamps.
import * as THREE from 'three/webgpu';

const STONE = 0xd8cdb8;

function material(color, roughness = 0.9) {
  return new THREE.MeshStandardMaterial({ color, roughness });
}

/** Casts and receives. */
function solid(geometry, stuff, x, y, z) {
  const mesh = new THREE.Mesh(geometry, stuff);
  mesh.position.set(x, y, z);
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** A row of columns with a beam over them. Columns are one InstancedMesh. */
function colonnade() {
  const group = new THREE.Group();
  const stone = material(STONE);
  const places = [];
  for (let i = 0; i < 7; ++i) {
    places.push([-7.2 + 2.4 * i, -6], [-8.4, -4.8 + 2.4 * i]);
  }
  const columns = new THREE.InstancedMesh(new THREE.CylinderGeometry(0.24, 0.3, 3.4, 24), stone, places.length);
  const at = new THREE.Matrix4();
  places.forEach(([x, z], i) => columns.setMatrixAt(i, at.makeTranslation(x, 1.7, z)));
  columns.castShadow = columns.receiveShadow = true;
  columns.name = 'columns';
  group.add(columns, solid(new THREE.BoxGeometry(16.2, 0.5, 0.8), stone, -0.6, 3.65, -6), solid(new THREE.BoxGeometry(0.8, 0.5, 15.6), stone, -8.4, 3.65, 2.0));
  return group;
}

/** Leaves are holes in a texture's alpha. */
function leafTexture() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 128;
  const draw = canvas.getContext('2d');
  for (let i = 0; i < 60; ++i) {
    draw.fillStyle = ['#4d7a38', '#5f8f43', '#3f6a30'][i % 3];
    draw.beginPath();
    draw.ellipse(8 + (i * 37) % 112, 8 + (i * 53) % 112, 11, 5, i, 0, 7);
    draw.fill();
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}

function tree() {
  const group = new THREE.Group();
  group.add(solid(new THREE.CylinderGeometry(0.14, 0.24, 2.2, 12), material(0x6b5138), 0, 1.1, 0));
  const leaves = new THREE.MeshStandardMaterial({ map: leafTexture(), alphaTest: 0.5, side: THREE.DoubleSide, roughness: 1 });
  for (let i = 0; i < 26; ++i) {
    const card = solid(new THREE.PlaneGeometry(1.5, 1.5), leaves, Math.sin(i * 2.4) * (0.3 + (i % 5) * 0.2), 2.1 + (i % 7) * 0.26, Math.cos(i * 2.4) * (0.3 + (i % 4) * 0.22));
    card.rotation.set(i * 1.3, i * 2.1, i * 0.7);
    group.add(card);
  }
  group.position.set(4.6, 0, -2.4);
  return group;
}

function fountain() {
  const group = new THREE.Group();
  const stone = material(0xbfb6a6);
  group.add(solid(new THREE.CylinderGeometry(2.1, 2.2, 0.5, 48), stone, 0, 0.25, 0), solid(new THREE.CylinderGeometry(0.25, 0.4, 1.5, 24), stone, 0, 1.2, 0),
    solid(new THREE.SphereGeometry(0.45, 32, 24), material(0xc9a23a, 0.35), 0, 2.25, 0));
  return group;
}

/** The scene, and a function that moves it. */
export function makeCourt() {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xb9cfdd);
  const ground = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), material(0xcbb994));
  ground.rotation.x = -Math.PI / 2;
  ground.receiveShadow = true;
  const knot = solid(new THREE.TorusKnotGeometry(0.6, 0.18, 160, 20), material(0x2f6f8f, 0.4), -4.2, 1.5, 2.6);
  scene.add(ground, colonnade(), tree(), fountain(), knot, new THREE.HemisphereLight(0xcfe4ff, 0x8a7a5c, 0.9));
  for (let i = 0; i < 5; ++i) {
    scene.add(solid(new THREE.BoxGeometry(0.9, 0.9, 0.9), material(0xa8583a), 2.4 + 1.1 * (i % 3), 0.45 + 0.9 * Math.floor(i / 3), 4.6 + 0.1 * i));
  }
  const sun = new THREE.DirectionalLight(0xfff2dc, 3.2);
  const spot = new THREE.SpotLight(0xffd9a0, 160, 22, 0.5, 0.4);
  spot.position.set(7, 6, 7);
  spot.target.position.set(2.6, 0.4, 4.2);
  spot.userData.gnomon = { radius: 0.12 };
  const lamp = new THREE.PointLight(0xffb070, 40, 14);
  lamp.userData.gnomon = { radius: 0.08 };
  for (const light of [sun, spot, lamp]) {
    light.castShadow = true;
  }
  scene.add(sun, sun.target, spot, spot.target, lamp);

  const move = (time_s, height_deg, lamps) => {
    const height = THREE.MathUtils.degToRad(height_deg);
    sun.position.set(30 * Math.cos(height) * 0.86, 30 * Math.sin(height), -30 * Math.cos(height) * 0.5);
    knot.rotation.set(0.4 * time_s, 0.6 * time_s, 0);
    lamp.position.set(-5.4 + 1.2 * Math.sin(0.7 * time_s), 2.4, -2.6 + 1.2 * Math.cos(0.7 * time_s));
    lamp.visible = spot.visible = lamps;
  };
  move(0, 34, true);
  return { scene, sun, spot, lamp, knot, ground, move };
}
