// What is drawn besides figures and goals: light, shadows, floor, the grids behind the orthographic views, axes.
import {
  BufferGeometry,
  Color,
  DirectionalLight,
  Float32BufferAttribute,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  Vector3,
  type Camera,
} from "three";
import { axisColors, type Palette } from "./palette";
import { isOrtho, viewNames, type ViewName } from "./names";

const kExtent = 6;
const kFine = 0.25;
const kFade = 5.5;

export class Stage {
  readonly scene = new Scene();
  /** From above and fixed in the world: its shadows tell how high things stand. */
  private readonly sun = new DirectionalLight(0xffffff, 1.6);
  private readonly key = new DirectionalLight(0xffffff, 1);
  private readonly fill = new DirectionalLight(0xbfd4ff, 0.5);
  private readonly shadow = new ShadowMaterial({ depthWrite: false });
  private readonly floor = new Mesh(new PlaneGeometry(12, 12), this.shadow);
  private grids: Record<ViewName, LineSegments> | null = null;
  private drawnFor: Palette | null = null;

  /** `shadows`: pixels across the map of shadows. */
  constructor(shadows: number) {
    this.scene.add(new HemisphereLight(0xffffff, 0xb0aca8, 2.1));
    for (const light of [this.sun, this.key, this.fill]) this.scene.add(light, light.target);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(shadows, shadows);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.01;
    this.sun.shadow.radius = 5;
    this.floor.receiveShadow = true;
    this.floor.renderOrder = -1;
    this.scene.add(this.floor);
  }

  dress(palette: Palette): void {
    if (this.drawnFor === palette) return;
    this.drawnFor = palette;
    if (this.grids) for (const drawn of new Set(Object.values(this.grids))) discard(drawn);
    const ground = drawnLines([...grid(0, 1, palette), ...axes()]);
    this.grids = { top: ground, perspective: ground, front: wall(1, palette), side: wall(0, palette) };
    this.scene.add(ground, this.grids.front, this.grids.side);
    this.shadow.opacity = palette.shadow;
  }

  /** The shadows' light covers what is looked at. */
  shine(centre: Vector3, reach: number): void {
    this.sun.target.position.copy(centre);
    this.sun.position.copy(centre).add(new Vector3(0.9, -0.8, 3.2).normalize().multiplyScalar(6));
    const camera = this.sun.shadow.camera;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    [camera.near, camera.far] = [0.5, 12];
    camera.updateProjectionMatrix();
  }

  /** Light comes over the viewer's shoulder in every view, and only the grid that faces the viewer shows. */
  face(name: ViewName, camera: Camera, focus: Vector3): void {
    const shoulder = new Vector3(-0.45, 0.75, 1).applyQuaternion(camera.quaternion);
    this.key.target.position.copy(focus);
    this.key.position.copy(focus).addScaledVector(shoulder, 4);
    const other = new Vector3(0.9, -0.2, 0.4).applyQuaternion(camera.quaternion);
    this.fill.target.position.copy(focus);
    this.fill.position.copy(focus).addScaledVector(other, 4);
    // Only strengths change between the panes: another set of lights would be another set of programs.
    this.sun.intensity = isOrtho(name) ? 0.4 : 2.1;
    this.key.intensity = isOrtho(name) ? 2.3 : 0.8;
    this.floor.visible = !isOrtho(name);
    if (!this.grids) return;
    for (const view of viewNames) this.grids[view].visible = false;
    this.grids[name].visible = true;
  }
}

/** Points two by two, and the colour that fades into the background's away from the origin. */
interface Lines {
  points: number[];
  color: number;
  background: number;
}

/** All of them in one draw call: a frame draws them four times. */
function drawnLines(all: readonly Lines[]): LineSegments {
  const colors: number[] = [];
  for (const { points, color, background } of all) {
    const [near, far, mixed] = [new Color(color), new Color(background), new Color()];
    for (let i = 0; i < points.length; i += 3) {
      const away = Math.hypot(points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0) / kFade;
      mixed.copy(near).lerp(far, Math.min(1, away ** 2));
      colors.push(mixed.r, mixed.g, mixed.b);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(all.flatMap(({ points }) => points), 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  const drawn = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, depthWrite: false }));
  drawn.renderOrder = -2;
  drawn.frustumCulled = false;
  return drawn;
}

/** A grid in the plane of two axes, through the origin, in pieces so that it can fade. */
function grid(a: number, b: number, palette: Palette): Lines[] {
  const fine: number[] = [];
  const coarse: number[] = [];
  for (let i = -kExtent / kFine; i <= kExtent / kFine; i++) {
    const into = i % Math.round(1 / kFine) === 0 ? coarse : fine;
    for (const [along, across] of [[a, b], [b, a]] as const) {
      for (let from = -kExtent; from < kExtent; from++) {
        for (const end of [from, from + 1]) {
          const point = [0, 0, 0];
          point[along] = end;
          point[across] = i * kFine;
          into.push(...point);
        }
      }
    }
  }
  const { background } = palette;
  return [{ points: fine, color: palette.gridFine, background }, { points: coarse, color: palette.gridCoarse, background }];
}

/** An upright grid far behind the figure, and the floor seen edge on. */
function wall(across: 0 | 1, palette: Palette): LineSegments {
  const ends: number[] = [];
  for (const end of [-40, 40]) {
    const point = [0, 0, 0];
    point[across] = end;
    ends.push(...point);
  }
  const upright = drawnLines([...grid(across, 2, palette), { points: ends, color: palette.floorLine, background: palette.floorLine }]);
  // Drawn first and without depth, it lies behind everything wherever it stands.
  (upright.material as LineBasicMaterial).depthTest = false;
  return upright;
}

function axes(): Lines[] {
  const tips = { x: [0.25, 0, 0], y: [0, 0.25, 0], z: [0, 0, 0.25] };
  return (["x", "y", "z"] as const).map((axis) => ({ points: [0, 0, 0, ...tips[axis]], color: axisColors[axis], background: axisColors[axis] }));
}

function discard(drawn: LineSegments): void {
  drawn.removeFromParent();
  drawn.geometry.dispose();
  (drawn.material as LineBasicMaterial).dispose();
}
