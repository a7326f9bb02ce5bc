// A map as instanced meshes of three.js. World frame: ENU, z up, metres.
import * as THREE from "three";
import type { MeshData, PageData, WorldData } from "./data";
import { wayAt } from "./motion";
import { Unpacked } from "./packed";

/** In the order of the program's materials: soil, bark, leaf, brick, concrete, painted metal, lamp. */
const kLight = ["#a89a7d", "#8a6a4a", "#7fa05a", "#b0705a", "#a9adb0", "#7b93b5", "#f2e4b0"];
const kDark = ["#6e6552", "#75583c", "#567a3c", "#8f5a48", "#7d8286", "#5b7396", "#cfc08a"];

interface Geometry {
  geometry: THREE.BufferGeometry;
  materials: number[];
}

function readGeometry(data: MeshData): Geometry {
  const u = new Unpacked(data.data);
  const axes = [0, 1, 2].map(() => u.deltas(data.vertices));
  const positions = new Float32Array(3 * data.vertices);
  for (let i = 0; i < data.vertices; ++i) for (let k = 0; k < 3; ++k) positions[3 * i + k] = axes[k][i] / 4095;
  const corners = u.deltas(3 * data.triangles);
  const material = u.raw(data.triangles);
  // Triangles of one material together: a group each.
  const used = [...new Set(material)].sort((a, b) => a - b);
  const index = new Uint32Array(3 * data.triangles);
  const geometry = new THREE.BufferGeometry();
  let at = 0;
  used.forEach((m, group) => {
    const from = at;
    for (let t = 0; t < data.triangles; ++t) {
      if (material[t] !== m) continue;
      for (let k = 0; k < 3; ++k) index[at++] = corners[3 * t + k];
    }
    geometry.addGroup(from, at - from, group);
  });
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return { geometry, materials: used };
}

interface Placed {
  mesh: THREE.InstancedMesh;
  slot: number;
  matrix: THREE.Matrix4;
}

/** A map in a scene: made once, thrown away with dispose(). */
export class MapModel {
  readonly group = new THREE.Group();
  private readonly placed: Placed[] = [];
  private readonly ofObstacle = new Map<number, Placed[]>();
  private readonly garbage: { dispose(): void }[] = [];
  private struck: number | null = null;

  constructor(
    page: PageData,
    private readonly world: WorldData,
    dark: boolean,
  ) {
    const u = new Unpacked(world.data);
    const prototypes = Array.from({ length: world.prototypes }, () => {
      const mesh = u.unsigned();
      const low: number[] = [];
      const size: number[] = [];
      for (let k = 0; k < 3; ++k) {
        low.push(u.signed() / 1000);
        size.push(u.signed() / 1000);
      }
      return { mesh, low, size };
    });
    const n = world.instances;
    const [prototype, obstacle, kind, scale] = [0, 1, 2, 3].map(() => u.deltas(n));
    const place = [0, 1, 2].map(() => u.deltas(n));
    const turn = [0, 1, 2, 3].map(() => u.deltas(n));
    // Instances of one mesh and one look together.
    const batches = new Map<string, number[]>();
    for (let i = 0; i < n; ++i) {
      const word = world.kinds[kind[i]];
      if (word === "ceiling" || word === "roof") continue;
      const name = `${prototypes[prototype[i]].mesh} ${word === "wall" ? "wall" : ""}`;
      const list = batches.get(name);
      if (list) list.push(i);
      else batches.set(name, [i]);
    }
    const palette = dark ? kDark : kLight;
    const matrixOf = (i: number): THREE.Matrix4 => {
      const p = prototypes[prototype[i]];
      const q = new THREE.Quaternion(turn[1][i], turn[2][i], turn[3][i], turn[0][i]).normalize();
      const s = scale[i] * 0.0001;
      const outer = new THREE.Matrix4().compose(
        new THREE.Vector3(place[0][i] / 1000, place[1][i] / 1000, place[2][i] / 1000),
        q,
        new THREE.Vector3(s, s, s),
      );
      // Meshes are within [0, 1] along each side of their box; flat ones keep a little height.
      const box = new THREE.Matrix4()
        .makeScale(p.size[0] || 1e-4, p.size[1] || 1e-4, p.size[2] || 1e-4)
        .setPosition(p.low[0], p.low[1], p.low[2]);
      return outer.multiply(box);
    };
    const slots: (Placed | null)[] = new Array<Placed | null>(n).fill(null);
    for (const [name, members] of batches) {
      const { geometry, materials } = readGeometry(page.meshes[prototypes[prototype[members[0]]].mesh]);
      const isWall = name.endsWith("wall");
      const looks = materials.map(
        (m) =>
          new THREE.MeshLambertMaterial({
            color: palette[m] ?? palette[4],
            flatShading: true,
            side: THREE.DoubleSide,
            transparent: isWall,
            opacity: isWall ? 0.16 : 1,
            depthWrite: !isWall,
          }),
      );
      const mesh = new THREE.InstancedMesh(geometry, looks, members.length);
      mesh.frustumCulled = false;
      if (isWall) mesh.userData.isWall = true;
      members.forEach((i, slot) => {
        const matrix = matrixOf(i);
        mesh.setMatrixAt(slot, matrix);
        const one = { mesh, slot, matrix };
        this.placed.push(one);
        slots[i] = one;
        const list = this.ofObstacle.get(obstacle[i]);
        if (list) list.push(one);
        else this.ofObstacle.set(obstacle[i], [one]);
      });
      this.group.add(mesh);
      this.garbage.push(geometry, mesh, ...looks);
    }
    this.moving = world.motions
      .map((path) => ({
        path,
        placed: slots[path.instance],
        rest: new THREE.Vector3(...([0, 1, 2].map((k) => place[k][path.instance] / 1000) as [number, number, number])),
      }))
      .filter((m) => m.placed !== null) as typeof this.moving;
  }

  private readonly moving: { path: WorldData["motions"][number]; placed: Placed; rest: THREE.Vector3 }[];

  /** Puts what moves where it stands at a time. */
  setTime(time: number): void {
    for (const m of this.moving) {
      const way = wayAt(m.path, time);
      const moved = new THREE.Matrix4()
        .makeTranslation(m.rest.x + way.offset[0], m.rest.y + way.offset[1], m.rest.z + way.offset[2])
        .multiply(new THREE.Matrix4().makeRotationZ(way.turn))
        .multiply(new THREE.Matrix4().makeTranslation(-m.rest.x, -m.rest.y, -m.rest.z))
        .multiply(m.placed.matrix);
      m.placed.mesh.setMatrixAt(m.placed.slot, moved);
      m.placed.mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** Reddens the obstacle that was struck; null: none. */
  setStruck(obstacle: number | null): void {
    const paint = (index: number | null, color: THREE.Color): void => {
      for (const { mesh, slot } of (index === null ? undefined : this.ofObstacle.get(index)) ?? []) {
        if (!mesh.instanceColor) for (let i = 0; i < mesh.count; ++i) mesh.setColorAt(i, new THREE.Color(1, 1, 1));
        mesh.setColorAt(slot, color);
        mesh.instanceColor!.needsUpdate = true;
      }
    };
    if (this.struck === obstacle) return;
    paint(this.struck, new THREE.Color(1, 1, 1));
    // The ground and walls are everywhere: red ones would say nothing.
    const isPlace = obstacle === null || obstacle < 0 || this.isWide(obstacle);
    this.struck = isPlace ? null : obstacle;
    paint(this.struck, new THREE.Color(3.2, 0.5, 0.35));
  }

  private isWide(obstacle: number): boolean {
    const [one] = this.ofObstacle.get(obstacle) ?? [];
    if (!one) return true;
    const size = new THREE.Vector3().setFromMatrixScale(one.matrix);
    const [low, high] = this.world.flight_bounds;
    return Math.max(size.x, size.y) > 0.6 * Math.max(high[0] - low[0], high[1] - low[1]);
  }

  dispose(): void {
    for (const one of this.garbage) one.dispose();
    this.group.removeFromParent();
  }
}
