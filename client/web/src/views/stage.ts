// What is drawn besides figures and goals: light, floor, the grids behind the orthographic views, axes.
import {
  AmbientLight,
  BufferGeometry,
  DirectionalLight,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Scene,
  Vector3,
  type Camera,
} from "three";
import { axisColors, floorLine, gridCoarse, gridFine } from "./palette";
import { viewNames, type ViewName } from "./names";

const kExtent = 4;
const kFine = 0.25;

export class Stage {
  readonly scene = new Scene();
  private readonly key = new DirectionalLight(0xffffff, 2.1);
  private readonly fill = new DirectionalLight(0xbfd4ff, 0.7);
  private readonly grids: Record<ViewName, Group>;

  constructor() {
    this.scene.add(new AmbientLight(0xffffff, 0.85), this.key, this.key.target, this.fill, this.fill.target);
    const floor = grid(0, 1);
    this.grids = { top: floor, perspective: floor, front: wall(1), side: wall(0) };
    this.scene.add(floor, this.grids.front, this.grids.side, axes());
  }

  /** Light comes over the viewer's shoulder in every view, and only the grid that faces the viewer shows. */
  face(name: ViewName, camera: Camera, focus: Vector3): void {
    const shoulder = new Vector3(-0.45, 0.75, 1).applyQuaternion(camera.quaternion);
    this.key.target.position.copy(focus);
    this.key.position.copy(focus).addScaledVector(shoulder, 4);
    const other = new Vector3(0.9, -0.2, 0.4).applyQuaternion(camera.quaternion);
    this.fill.target.position.copy(focus);
    this.fill.position.copy(focus).addScaledVector(other, 4);
    for (const view of viewNames) this.grids[view].visible = false;
    this.grids[name].visible = true;
  }
}

function lines(points: number[], color: number): LineSegments {
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
  const drawn = new LineSegments(geometry, new LineBasicMaterial({ color, depthWrite: false }));
  drawn.renderOrder = -1;
  drawn.frustumCulled = false;
  return drawn;
}

/** A grid in the plane of two axes, through the origin. */
function grid(a: number, b: number): Group {
  const fine: number[] = [];
  const coarse: number[] = [];
  for (let i = -kExtent / kFine; i <= kExtent / kFine; i++) {
    const into = i % Math.round(1 / kFine) === 0 ? coarse : fine;
    for (const [along, across] of [[a, b], [b, a]] as const) {
      for (const end of [-kExtent, kExtent]) {
        const point = [0, 0, 0];
        point[along] = end;
        point[across] = i * kFine;
        into.push(...point);
      }
    }
  }
  return new Group().add(lines(fine, gridFine), lines(coarse, gridCoarse));
}

/** An upright grid far behind the figure, and the floor seen edge on. */
function wall(across: 0 | 1): Group {
  const upright = grid(across, 2);
  const ends: number[] = [];
  for (const end of [-40, 40]) {
    const point = [0, 0, 0];
    point[across] = end;
    ends.push(...point);
  }
  upright.add(lines(ends, floorLine));
  // Drawn first and without depth, it lies behind everything wherever it stands.
  upright.traverse((part) => {
    if (part instanceof LineSegments) (part.material as LineBasicMaterial).depthTest = false;
  });
  return upright;
}

function axes(): Group {
  const length = 0.25;
  return new Group().add(
    lines([0, 0, 0, length, 0, 0], axisColors.x),
    lines([0, 0, 0, 0, length, 0], axisColors.y),
    lines([0, 0, 0, 0, 0, length], axisColors.z),
  );
}
