// The 3-D view: map, paths, vehicles, camera frustum, what was seen and drawn. Draws only when something has changed.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { CameraData, DrawingData, PageData, Rig, Vector } from "./data";
import type { Flight } from "./flight";
import { placeOf, stateAt } from "./flight";
import { Unpacked } from "./packed";
import { MapModel } from "./world";

export type CameraMode = "orbit" | "follow" | "top";
export type PathColor = "planner" | "speed" | "clearance";

export interface Track {
  label: string;
  color: string;
  flight: Flight;
  rig: Rig;
  isMain: boolean;
  isShown: boolean;
  struck: { t: number; obstacle: number }[];
}

// Cividis (Nuñez et al. 2018), sampled: safe for colour-blind people.
const kCividis = [
  "#00224e",
  "#123570",
  "#3b496c",
  "#575d6d",
  "#707173",
  "#8a8678",
  "#a59c74",
  "#c3b369",
  "#e1cc55",
  "#fee838",
];
function cividis(share: number): THREE.Color {
  const at = Math.min(Math.max(share, 0), 1) * (kCividis.length - 1);
  const low = Math.min(Math.floor(at), kCividis.length - 2);
  return new THREE.Color(kCividis[low]).lerp(new THREE.Color(kCividis[low + 1]), at - low);
}
export const kScaleColors = kCividis;
/** Goals and the camera's frustum, on a light and on a dark ground: no planner's colour. */
const kInk = ["#20262c", "#f2f2f2"];
const kGrounds = ["#dfe8f0", "#10161d"];

interface Shown {
  track: Track;
  lines: Line2[];
  faint: THREE.Line;
  vehicle: THREE.Group;
  materials: LineMaterial[];
}

const kDepthMaterial = (near: number, far: number): THREE.ShaderMaterial =>
  new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    uniforms: { near: { value: near }, far: { value: far } },
    vertexShader: `varying float depth;
void main() {
  vec4 place = vec4(position, 1.0);
  #ifdef USE_INSTANCING
    place = instanceMatrix * place;
  #endif
  vec4 seen = modelViewMatrix * place;
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}`,
    // Turbo's polynomial (Mikhailov 2019): near things red, far ones blue, as in the program's pictures.
    fragmentShader: `varying float depth;
uniform float near;
uniform float far;
void main() {
  if (depth > far) { gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0); return; }
  float x = 1.0 - clamp((depth - near) / (far - near), 0.0, 1.0);
  vec4 v4 = vec4(1.0, x, x * x, x * x * x);
  vec2 v2 = v4.zw * v4.z;
  gl_FragColor = vec4(
    dot(v4, vec4(0.13572138, 4.61539260, -42.66032258, 132.13108234)) + dot(v2, vec2(-152.94239396, 59.28637943)),
    dot(v4, vec4(0.09140261, 2.19418839, 4.84296658, -14.18503333)) + dot(v2, vec2(4.27729857, 2.82956604)),
    dot(v4, vec4(0.10667330, 12.64194608, -60.58204836, 110.36276771)) + dot(v2, vec2(-89.90310912, 27.34824973)), 1.0);
}`,
  });

export class Viewer {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly overlay = new THREE.Group();
  private readonly camera = new THREE.PerspectiveCamera(55, 1, 0.05, 400);
  private readonly onboard = new THREE.PerspectiveCamera(90, 1, 0.05, 200);
  private readonly controls: OrbitControls;
  private readonly seen = new THREE.Group();
  private readonly drawn = new THREE.Group();
  private map: MapModel | null = null;
  private shown: Shown[] = [];
  private frustum: THREE.LineSegments | null = null;
  private ahead: THREE.Line | null = null;
  private mode: CameraMode = "orbit";
  private pathColor: PathColor = "planner";
  private time = 0;
  private asked = 0;
  private yaw = 0;
  private depthLook: THREE.ShaderMaterial;
  private hasInset = true;
  onLabels: ((labels: { label: string; color: string; x: number; y: number }[]) => void) | null = null;
  /** Fastest and slowest of the paths' colours. */
  range: [number, number] = [0, 1];

  constructor(
    canvas: HTMLCanvasElement,
    private readonly page: PageData,
    private readonly dark: boolean,
  ) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.camera.up.set(0, 0, 1);
    this.onboard.up.set(0, 0, 1);
    this.scene.background = new THREE.Color(kGrounds[dark ? 1 : 0]);
    this.scene.add(
      new THREE.HemisphereLight(dark ? "#c8d8ea" : "#ffffff", dark ? "#3a3226" : "#a89a84", dark ? 2.5 : 2.1),
    );
    const sun = new THREE.DirectionalLight("#ffffff", dark ? 1.5 : 1.5);
    sun.position.set(0.45, -0.35, 0.82);
    this.scene.add(sun, this.overlay);
    this.overlay.add(this.seen, this.drawn);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.draw());
    this.depthLook = kDepthMaterial(0.1, 15);
  }

  setWorld(index: number | null): void {
    this.map?.dispose();
    this.map = null;
    if (index !== null && this.page.worlds[index]) {
      this.map = new MapModel(this.page, this.page.worlds[index], this.dark);
      this.scene.add(this.map.group);
    }
    this.draw();
  }

  setTracks(tracks: Track[], start: Vector | null, goals: Vector[], goalRadius: number): void {
    for (const child of [...this.overlay.children])
      if (child !== this.seen && child !== this.drawn) this.overlay.remove(child);
    this.shown = tracks.map((track) => this.showTrack(track));
    this.frustum = null;
    const main = tracks.find((t) => t.isMain);
    const camera = main?.rig.cameras[0];
    if (camera) {
      this.frustum = new THREE.LineSegments(
        frustumGeometry(camera),
        new THREE.LineBasicMaterial({ color: kInk[this.dark ? 1 : 0], transparent: true, opacity: 0.7 }),
      );
      this.frustum.matrixAutoUpdate = false;
      this.overlay.add(this.frustum);
      this.depthLook = kDepthMaterial(camera.min_m, camera.max_m);
    }
    this.ahead = new THREE.Line(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: main?.color ?? kInk[0] }),
    );
    this.ahead.visible = false;
    this.overlay.add(this.ahead);
    const ink = kInk[this.dark ? 1 : 0];
    if (start) this.overlay.add(marker(start, 0.18, "#8a949e"));
    for (const goal of goals) {
      this.overlay.add(marker(goal, 0.18, ink));
      const ring = new THREE.Mesh(
        new THREE.TorusGeometry(goalRadius, 0.03, 6, 40),
        new THREE.MeshBasicMaterial({ color: ink }),
      );
      ring.position.set(...goal);
      this.overlay.add(ring);
    }
    if (start && goals.length > 1) {
      const legs = new THREE.BufferGeometry().setFromPoints([start, ...goals].map((p) => new THREE.Vector3(...p)));
      this.overlay.add(new THREE.Line(legs, new THREE.LineBasicMaterial({ color: ink })));
    }
    this.colorPaths();
    this.setTime(this.time);
  }

  private showTrack(track: Track): Shown {
    const f = track.flight;
    const positions: number[] = [];
    for (let i = 0; i < f.n; ++i) positions.push(f.x[i], f.y[i], f.z[i]);
    const lines: Line2[] = [];
    const materials: LineMaterial[] = [];
    // The whole path, and the part that has been flown, thicker.
    for (const width of f.n > 1 ? (track.isMain ? [2.5, 5.5] : [1.5, 3.5]) : []) {
      const geometry = new LineGeometry();
      geometry.setPositions(positions);
      const material = new LineMaterial({ linewidth: width, vertexColors: true, worldUnits: false });
      const line = new Line2(geometry, material);
      line.frustumCulled = false;
      this.overlay.add(line);
      lines.push(line);
      materials.push(material);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
    // Seen through what hides it.
    const faint = new THREE.Line(
      geometry,
      new THREE.LineBasicMaterial({
        color: track.color,
        transparent: true,
        opacity: track.isMain ? 0.5 : 0.3,
        depthTest: false,
      }),
    );
    faint.frustumCulled = false;
    const vehicle = vehicleModel(track.rig.body, track.color);
    this.overlay.add(faint, vehicle);
    return { track, lines, faint, vehicle, materials };
  }

  setPathColor(color: PathColor): void {
    this.pathColor = color;
    this.colorPaths();
    this.draw();
  }

  private colorPaths(): void {
    const values = (f: Flight): Float64Array => (this.pathColor === "clearance" ? f.clearance : f.speed);
    const all = this.shown.flatMap((s) => [...values(s.track.flight)]).filter(Number.isFinite);
    this.range = this.pathColor === "clearance" ? [0, 2] : [0, Math.max(0.5, ...all)];
    for (const { track, lines } of this.shown) {
      const f = track.flight;
      const colors: number[] = [];
      for (let i = 0; i < f.n; ++i) {
        const v = values(f)[i];
        const c =
          this.pathColor === "planner"
            ? new THREE.Color(track.color)
            : Number.isFinite(v)
              ? cividis((v - this.range[0]) / (this.range[1] - this.range[0]))
              : new THREE.Color("#888888");
        colors.push(c.r, c.g, c.b);
      }
      for (const line of lines) (line.geometry as LineGeometry).setColors(colors);
    }
  }

  setShown(isShown: (track: Track) => boolean): void {
    for (const s of this.shown) s.track.isShown = isShown(s.track);
    this.setTime(this.time);
  }

  setInset(hasInset: boolean): void {
    this.hasInset = hasInset;
    this.draw();
  }

  setTime(time: number): void {
    this.time = time;
    this.map?.setTime(time);
    let struck: number | null = null;
    for (const s of this.shown) {
      const { track, vehicle, lines, faint } = s;
      const state = stateAt(track.flight, time);
      for (const part of [vehicle, faint, ...lines]) part.visible = track.isShown && track.flight.n > 0;
      vehicle.position.set(...state.position);
      vehicle.quaternion.set(state.q[1], state.q[2], state.q[3], state.q[0]);
      if (lines[1])
        (lines[1].geometry as LineGeometry).instanceCount = Math.max(
          1,
          Math.min(track.flight.n - 1, placeOf(track.flight, time)[0] + 1),
        );
      if (!track.isMain) continue;
      for (const touch of track.struck) if (touch.t <= time + 1e-3) struck = touch.obstacle;
      this.placeOnboard(track, vehicle, state.index);
    }
    this.map?.setStruck(struck);
    if (this.mode === "follow") this.follow(false);
    this.draw();
  }

  private placeOnboard(track: Track, vehicle: THREE.Group, index: number): void {
    const camera = track.rig.cameras[0];
    vehicle.updateMatrixWorld();
    if (camera && this.frustum) {
      const { position, q } = camera.pose;
      const mount = new THREE.Matrix4().compose(
        new THREE.Vector3(...position),
        new THREE.Quaternion(q[1], q[2], q[3], q[0]),
        new THREE.Vector3(1, 1, 1),
      );
      const pose = new THREE.Matrix4().multiplyMatrices(vehicle.matrixWorld, mount);
      this.frustum.matrix.copy(pose);
      this.frustum.visible = track.isShown;
      // Ours looks along +z with y down; three's along −z with y up.
      const flipped = pose.clone().multiply(new THREE.Matrix4().makeRotationX(Math.PI));
      flipped.decompose(this.onboard.position, this.onboard.quaternion, new THREE.Vector3());
      this.onboard.aspect = camera.width / camera.height;
      this.onboard.fov =
        (2 * Math.atan(Math.tan((camera.fov_x_deg * Math.PI) / 360) / this.onboard.aspect) * 180) / Math.PI;
      this.onboard.updateProjectionMatrix();
    }
    const ahead = track.flight.ahead;
    if (this.ahead && ahead) {
      const d = ahead.map((a) => a[index]);
      this.ahead.visible = d.every(Number.isFinite) && track.isShown;
      if (this.ahead.visible) {
        const p = vehicle.position;
        this.ahead.geometry.setFromPoints([p.clone(), new THREE.Vector3(p.x + d[0], p.y + d[1], p.z + d[2])]);
      }
    }
  }

  /** Points of a depth image as seen, world frame; colours by their distance. */
  setPoints(points: Float32Array | null, colors: Float32Array | null): void {
    this.seen.clear();
    if (points && colors) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
      geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
      const cloud = new THREE.Points(
        geometry,
        new THREE.PointsMaterial({ size: 2.5, sizeAttenuation: false, vertexColors: true }),
      );
      cloud.frustumCulled = false;
      this.seen.add(cloud);
    }
    this.draw();
  }

  setDrawings(drawings: DrawingData[]): void {
    this.drawn.clear();
    for (const d of drawings) {
      if (d.n === 0 || d.kind === "text") continue;
      const u = new Unpacked(d.data);
      const axes = [0, 1, 2].map(() => u.deltas(d.n));
      const positions = new Float32Array(3 * d.n);
      for (let i = 0; i < d.n; ++i) for (let k = 0; k < 3; ++k) positions[3 * i + k] = 0.01 * axes[k][i];
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
      const color = new THREE.Color(d.color);
      const look = { color, transparent: true, opacity: 0.85, depthTest: d.kind === "points" };
      const object =
        d.kind === "points"
          ? new THREE.Points(geometry, new THREE.PointsMaterial({ ...look, size: 2, sizeAttenuation: false }))
          : d.kind === "line"
            ? new THREE.Line(geometry, new THREE.LineBasicMaterial(look))
            : new THREE.LineSegments(geometry, new THREE.LineBasicMaterial(look));
      object.frustumCulled = false;
      this.drawn.add(object);
    }
    this.draw();
  }

  setLayers(points: boolean, drawings: boolean): void {
    this.seen.visible = points;
    this.drawn.visible = drawings;
    this.draw();
  }

  setMode(mode: CameraMode, low: Vector, high: Vector, start: Vector | null, goal: Vector | undefined): void {
    this.mode = mode;
    this.controls.enabled = mode !== "follow";
    const middle = new THREE.Vector3((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2);
    const reach = Math.max(high[0] - low[0], high[1] - low[1], 4);
    const narrow = Math.min(1, this.camera.aspect);
    this.camera.up.set(0, 0, 1);
    if (mode === "top") {
      const height =
        (0.62 * Math.max(high[1] - low[1], (high[0] - low[0]) / Math.max(this.camera.aspect, 0.3), 4)) /
        Math.tan((this.camera.fov * Math.PI) / 360);
      this.controls.target.copy(middle);
      this.camera.position.set(middle.x, middle.y - 0.001, middle.z + height);
      this.camera.lookAt(middle);
      this.controls.update();
    } else if (mode === "follow") {
      this.follow(true);
    } else {
      const from =
        start && goal
          ? new THREE.Vector3(goal[0] - start[0], goal[1] - start[1], 0).normalize()
          : new THREE.Vector3(0, 1, 0);
      const eye = middle
        .clone()
        .addScaledVector(from, (-0.95 * reach) / narrow)
        .addScaledVector(new THREE.Vector3(from.y, -from.x, 0), 0.25 * reach);
      eye.z = middle.z + (0.72 * reach) / narrow;
      this.controls.target.copy(middle);
      this.camera.position.copy(eye);
      this.controls.update();
    }
    this.draw();
  }

  private follow(atOnce: boolean): void {
    const main = this.shown.find((s) => s.track.isMain);
    if (!main) return;
    const forward = new THREE.Vector3(1, 0, 0).applyQuaternion(main.vehicle.quaternion);
    const yaw = Math.atan2(forward.y, forward.x);
    const turn = Math.atan2(Math.sin(yaw - this.yaw), Math.cos(yaw - this.yaw));
    this.yaw = atOnce ? yaw : this.yaw + 0.25 * turn;
    const p = main.vehicle.position;
    this.camera.position.set(p.x - 3.2 * Math.cos(this.yaw), p.y - 3.2 * Math.sin(this.yaw), p.z + 1.3);
    this.controls.target.set(p.x + 1.5 * Math.cos(this.yaw), p.y + 1.5 * Math.sin(this.yaw), p.z);
    this.camera.lookAt(this.controls.target);
  }

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Where the main vehicle is, for whoever looks from outside. */
  place(): Vector | null {
    const main = this.shown.find((s) => s.track.isMain);
    return main ? (main.vehicle.position.toArray() as Vector) : null;
  }

  draw(): void {
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.drawNow();
    });
  }

  /** As a picture for paper: on a light ground. */
  picture(): string {
    const ground = this.scene.background;
    this.scene.background = new THREE.Color(kGrounds[0]);
    this.drawNow();
    this.scene.background = ground;
    this.draw();
    return this.renderer.domElement.toDataURL();
  }

  private drawNow(): void {
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x < 2 || size.y < 2) return;
    for (const s of this.shown) for (const material of s.materials) material.resolution.set(size.x, size.y);
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, size.x, size.y);
    this.renderer.render(this.scene, this.camera);
    if (this.hasInset && this.frustum?.visible && this.map) this.drawInset(size);
    this.onLabels?.(this.labels(size));
  }

  /** What an ideal camera would see, in the lower right corner. */
  private drawInset(size: THREE.Vector2): void {
    const width = Math.round(Math.min(240, 0.36 * size.x));
    const height = Math.round(width / this.onboard.aspect);
    this.renderer.setScissorTest(true);
    this.renderer.setScissor(size.x - width - 10, 10, width, height);
    this.renderer.setViewport(size.x - width - 10, 10, width, height);
    const background = this.scene.background;
    this.scene.background = new THREE.Color("#000000");
    this.scene.overrideMaterial = this.depthLook;
    this.overlay.visible = false;
    this.renderer.render(this.scene, this.onboard);
    this.overlay.visible = true;
    this.scene.overrideMaterial = null;
    this.scene.background = background;
    this.renderer.setScissorTest(false);
  }

  private labels(size: THREE.Vector2): { label: string; color: string; x: number; y: number }[] {
    return this.shown
      .filter((s) => s.track.isShown && s.track.flight.n > 0)
      .flatMap((s) => {
        const at = s.vehicle.position
          .clone()
          .add(new THREE.Vector3(0, 0, 0.35))
          .project(this.camera);
        return at.z > 1 || Math.abs(at.x) > 1 || Math.abs(at.y) > 1
          ? []
          : [
              {
                label: s.track.label,
                color: s.track.color,
                x: ((at.x + 1) / 2) * size.x,
                y: ((1 - at.y) / 2) * size.y,
              },
            ];
      });
  }

  dispose(): void {
    if (this.asked) cancelAnimationFrame(this.asked);
    this.map?.dispose();
    this.controls.dispose();
    this.renderer.dispose();
  }
}

function frustumGeometry(camera: CameraData): THREE.BufferGeometry {
  const depth = Math.min(2.5, camera.max_m);
  const x = depth * Math.tan((camera.fov_x_deg * Math.PI) / 360);
  const y = (x * camera.height) / camera.width;
  const corners = [
    [-x, -y],
    [x, -y],
    [x, y],
    [-x, y],
  ].map(([cx, cy]) => new THREE.Vector3(cx, cy, depth));
  const eye = new THREE.Vector3();
  return new THREE.BufferGeometry().setFromPoints(corners.flatMap((c, i) => [eye, c, c, corners[(i + 1) % 4]]));
}

function marker(place: Vector, radius: number, color: string): THREE.Object3D {
  const ball = new THREE.Mesh(new THREE.SphereGeometry(radius, 16, 12), new THREE.MeshBasicMaterial({ color }));
  const rod = new THREE.Mesh(
    new THREE.CylinderGeometry(0.02, 0.02, 4, 6),
    new THREE.MeshBasicMaterial({ color, transparent: true, opacity: 0.5 }),
  );
  rod.rotation.x = Math.PI / 2;
  const group = new THREE.Group();
  group.add(ball, rod);
  group.position.set(...place);
  return group;
}

/** A body of the vehicle's size with four rotors and a nose along x. */
function vehicleModel(body: Vector, color: string): THREE.Group {
  const group = new THREE.Group();
  const [length, width, height] = body;
  const look = new THREE.MeshLambertMaterial({ color, flatShading: true });
  const hull = new THREE.Mesh(new THREE.BoxGeometry(0.55 * length, 0.4 * width, Math.max(0.5 * height, 0.04)), look);
  const nose = new THREE.Mesh(
    new THREE.ConeGeometry(0.14 * width, 0.3 * length, 8),
    new THREE.MeshLambertMaterial({ color: "#f5f5f5" }),
  );
  nose.rotation.z = -Math.PI / 2;
  nose.position.x = 0.4 * length;
  group.add(hull, nose);
  for (const [sx, sy] of [
    [1, 1],
    [1, -1],
    [-1, 1],
    [-1, -1],
  ]) {
    const rotor = new THREE.Mesh(
      new THREE.CylinderGeometry(0.22 * width, 0.22 * width, 0.02, 18),
      new THREE.MeshLambertMaterial({ color, transparent: true, opacity: 0.75 }),
    );
    rotor.rotation.x = Math.PI / 2;
    rotor.position.set(0.3 * length * sx, 0.3 * width * sy, 0.4 * height);
    group.add(rotor);
  }
  return group;
}
