// An arm in its cell in three dimensions: one view a trial, one camera for all, to be turned with pointer or arrow keys.
import {
  AmbientLight, BufferAttribute, BufferGeometry, CapsuleGeometry, DirectionalLight, DoubleSide, EdgesGeometry, Group,
  Line, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, PerspectiveCamera, PlaneGeometry, Quaternion, Scene, SphereGeometry,
  Spherical, Vector3, WebGLRenderer, Color,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const UP = new Vector3(0, 1, 0);
// From z upwards, as here, to y upwards, as spherical coordinates have it.
const UPRIGHT = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), UP);
// What a press of an arrow key turns, and which way: about the vertical, towards the ground.
const TURN = Math.PI / 12;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];

export function arm(stage, replay) {
  const row = stage.appendChild(document.createElement("div"));
  row.className = "lanes";
  const extent = bounds(replay);
  const camera = new PerspectiveCamera(40, 4 / 3, extent.size / 200, extent.size * 20);
  camera.up.set(0, 0, 1);
  camera.position.copy(extent.middle).add(new Vector3(1.1, -1.5, 0.9).multiplyScalar(extent.size));
  const views = replay.lanes.map((lane, index) => view(row, replay, lane, COLOURS[index % COLOURS.length], camera, extent));
  const paint = () => views.forEach((each) => each.renderer.render(each.scene, camera));
  const turns = views.map((each) => turned(each.renderer.domElement, camera, extent.middle, paint));
  const steps = Math.max(...views.map((each) => each.count)) - 1;
  const draw = (step) => {
    // In step: each trial is as far along its own way as the others.
    const shown = views.map((each) => each.put(Math.round((step / Math.max(steps, 1)) * Math.max(each.count - 1, 0))));
    paint();
    return `${step} of ${steps}: ${shown.join("; ")}`;
  };
  const end = () => {
    turns.forEach((controls) => controls.dispose());
    views.forEach((each) => each.renderer.dispose());
  };
  return { steps: Math.max(steps, 0), perSecond: 20, draw, end };
}

// Turns the camera about `middle` with the pointer or arrow keys. The wheel and two fingers zoom once the canvas has the focus, so
// that the page can be scrolled past it.
function turned(canvas, camera, middle, paint) {
  const controls = new OrbitControls(camera, canvas);
  controls.target.copy(middle);
  controls.enableZoom = false;
  canvas.style.touchAction = "pan-y";
  canvas.addEventListener("focus", () => (controls.enableZoom = true));
  canvas.addEventListener("blur", () => (controls.enableZoom = false));
  canvas.addEventListener("keydown", (event) => {
    const [about, up] = ARROWS[event.key] ?? [0, 0];
    if (!about && !up) return;
    event.preventDefault();
    const from = new Spherical().setFromVector3(camera.position.clone().sub(middle).applyQuaternion(UPRIGHT));
    from.theta += about * TURN;
    from.phi += up * TURN;
    from.makeSafe();
    camera.position.setFromSpherical(from).applyQuaternion(UPRIGHT.clone().invert()).add(middle);
    controls.update();
  });
  controls.addEventListener("change", paint);
  controls.update();
  return controls;
}

function view(row, replay, lane, colour, camera, extent) {
  const figure = row.appendChild(document.createElement("figure"));
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(640, 480, false);
  const canvas = figure.appendChild(renderer.domElement);
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${lane.label}: the arm in its cell; turn it with the arrow keys`);
  const caption = figure.appendChild(document.createElement("figcaption"));
  const scene = new Scene();
  scene.background = new Color("#ffffff");
  scene.add(new AmbientLight("#ffffff", 1.6));
  const sun = new DirectionalLight("#ffffff", 2);
  sun.position.set(1, -2, 3);
  scene.add(sun);
  furnish(scene, replay, extent);
  const body = parts(lane, colour);
  scene.add(body.group);
  if (lane.way.length > 1) scene.add(polyline(lane.way, "#888888"));
  const walked = body.count ? body.tips : lane.way;
  const trail = walked.length > 1 ? polyline(walked, colour) : null;
  if (trail) scene.add(trail);
  const count = body.count || lane.way.length;
  const put = (step) => {
    body.put(step, lane.way[step]);
    trail?.geometry.setDrawRange(0, step + 1);
    const clearance = lane.clearance[step];
    const near = clearance === undefined ? "" : clearance > 0 ? `, clearance ${clearance.toFixed(1)} mm` : ", in contact";
    body.touch(clearance !== undefined && clearance <= 0);
    caption.textContent = `${lane.label}: ${lane.ending}${near}`;
    return count ? `${lane.label}${near}` : `${lane.label}: ${lane.ending}`;
  };
  return { renderer, scene, count, put };
}

// Obstacles and floor.
function furnish(scene, replay, extent) {
  const paint = new MeshLambertMaterial({ color: "#d9b44a", transparent: true, opacity: 0.5, depthWrite: false, side: DoubleSide });
  for (const solid of replay.solids) {
    const corners = solid.faces.flatMap((face) => face.slice(2).flatMap((_, k) => [face[0], face[k + 1], face[k + 2]]));
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flatMap((corner) => solid.vertices[corner])), 3));
    geometry.computeVertexNormals();
    scene.add(new Mesh(geometry, paint), new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: "#6b5a20" })));
  }
  for (const [ax, ay, az, bx, by, bz, radius] of replay.rounds) {
    const capsule = rod(radius, new Vector3(ax, ay, az).distanceTo(new Vector3(bx, by, bz)), paint);
    lay(capsule, [ax, ay, az, bx, by, bz]);
    scene.add(capsule);
  }
  if (replay.floor !== null) {
    const floor = new Mesh(new PlaneGeometry(2 * extent.size, 2 * extent.size), new MeshLambertMaterial({ color: "#e4e4e4", side: DoubleSide }));
    floor.position.set(extent.middle.x, extent.middle.y, replay.floor);
    scene.add(floor);
  }
}

// The arm's parts: meshes once, laid anew in each frame. A point without an arm is a ball.
function parts(lane, colour) {
  const group = new Group();
  const material = new MeshLambertMaterial({ color: colour });
  const numbers = unpacked(lane);
  const wide = 6 * lane.radii.length + 3;
  const count = lane.radii.length ? numbers.length / wide : 0;
  const at = (frame, from, length) => Array.from(numbers.subarray(frame * wide + from, frame * wide + from + length), (n) => n * lane.step);
  const rods = lane.radii.map((radius, part) => {
    const [ax, ay, az, bx, by, bz] = at(0, 6 * part, 6);
    const mesh = rod(radius, Math.hypot(bx - ax, by - ay, bz - az), material);
    group.add(mesh);
    return mesh;
  });
  const ball = count || !lane.way.length ? null : group.add(new Mesh(new SphereGeometry(15), material)).children[0];
  const tips = Array.from({ length: count }, (_, frame) => at(frame, wide - 3, 3));
  return {
    group,
    tips,
    count,
    put: (frame, point) => {
      rods.forEach((mesh, part) => lay(mesh, at(frame, 6 * part, 6)));
      if (ball && point) ball.position.set(...point);
    },
    touch: (is) => material.color.set(is ? "#e00000" : colour),
  };
}

// Frames as whole multiples of the lane's step.
function unpacked(lane) {
  const bytes = Uint8Array.from(atob(lane.frames), (c) => c.charCodeAt(0));
  return new Int16Array(bytes.buffer, 0, bytes.length >> 1);
}

// Every point of an arm's frames.
function placesOf(lane) {
  const numbers = unpacked(lane);
  return Array.from({ length: Math.floor(numbers.length / 3) }, (_, at) => Array.from(numbers.subarray(3 * at, 3 * at + 3), (n) => n * lane.step));
}

function rod(radius, length, material) {
  return new Mesh(length > 0 ? new CapsuleGeometry(radius, length, 6, 14) : new SphereGeometry(radius, 16, 12), material);
}

function lay(mesh, [ax, ay, az, bx, by, bz]) {
  const along = new Vector3(bx - ax, by - ay, bz - az);
  mesh.position.set((ax + bx) / 2, (ay + by) / 2, (az + bz) / 2);
  if (along.lengthSq() > 0) mesh.quaternion.copy(new Quaternion().setFromUnitVectors(UP, along.normalize()));
}

function polyline(points, colour) {
  const geometry = new BufferGeometry().setFromPoints(points.map((point) => new Vector3(...point)));
  return new Line(geometry, new LineBasicMaterial({ color: colour }));
}

function bounds(replay) {
  const points = [
    ...replay.solids.flatMap((solid) => solid.vertices),
    ...replay.lanes.flatMap((lane) => [...lane.way, ...placesOf(lane)]),
    ...(replay.lanes.some((lane) => lane.radii.length) ? [[0, 0, 0]] : []),
  ];
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = new Vector3(-Infinity, -Infinity, -Infinity);
  for (const point of points) {
    low.min(new Vector3(...point));
    high.max(new Vector3(...point));
  }
  return { middle: low.clone().add(high).multiplyScalar(0.5), size: Math.max(high.distanceTo(low) / 1.6, 100) };
}
