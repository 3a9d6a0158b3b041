// Each sensor as a small triad of axes where the tracker stream says it is.
import { Group, Mesh, MeshBasicMaterial, SphereGeometry, CylinderGeometry, type Camera } from "three";
import type { Model } from "../state/model";
import { axisColors } from "./palette";
import { metresPerPixel, type PaneRect } from "./projection";

const kTriadPixels = 26;
const kTriadMetres = 0.07;

const arm = new CylinderGeometry(0.045, 0.045, 1, 10).translate(0, 0.5, 0);
const hub = new SphereGeometry(0.1, 14, 10);
const materials = {
  x: new MeshBasicMaterial({ color: axisColors.x }),
  y: new MeshBasicMaterial({ color: axisColors.y }),
  z: new MeshBasicMaterial({ color: axisColors.z }),
  hub: new MeshBasicMaterial({ color: 0xe8ebf0 }),
};

export class SensorView {
  readonly group = new Group();
  private readonly triads = new Map<string, Group>();

  update(model: Model): void {
    for (const [sensor, triad] of this.triads) triad.visible = model.samples.has(sensor);
    for (const [sensor, { position, quat_xyzw }] of model.samples) {
      const triad = this.triad(sensor);
      triad.position.set(...position);
      triad.quaternion.set(...quat_xyzw);
    }
  }

  scaleFor(camera: Camera, rect: PaneRect): void {
    for (const triad of this.triads.values()) {
      triad.scale.setScalar(Math.max(kTriadMetres, kTriadPixels * metresPerPixel(camera, rect, triad.position)));
    }
  }

  private triad(sensor: string): Group {
    let triad = this.triads.get(sensor);
    if (!triad) {
      triad = buildTriad();
      this.triads.set(sensor, triad);
      this.group.add(triad);
    }
    return triad;
  }
}

function buildTriad(): Group {
  const x = new Mesh(arm, materials.x);
  const y = new Mesh(arm, materials.y);
  const z = new Mesh(arm, materials.z);
  x.rotation.z = -Math.PI / 2;
  z.rotation.x = Math.PI / 2;
  return new Group().add(x, y, z, new Mesh(hub, materials.hub));
}
