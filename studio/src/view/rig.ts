// The camera: orthographic, so that a millimetre is as long everywhere in the picture, with preset views.
import { OrthographicCamera, Vector3 } from 'three';

export type ViewName = 'overview' | 'side' | 'front' | 'along';

// Directions of one insertion: into the tissue, the way the bow goes, and across both, towards the person.
export interface Axes {
  entry: Vector3;
  along: Vector3;
  sideways: Vector3;
  across: Vector3;
}

export function axesOf(entry: readonly number[], direction: readonly number[]): Axes {
  const along = new Vector3(...(direction as [number, number, number])).normalize();
  const sideways = new Vector3().crossVectors(along, new Vector3(0, 1, 0));
  if (sideways.length() > 0.5) sideways.normalize();
  else sideways.set(1, 0, 0);
  return { entry: new Vector3(...(entry as [number, number, number])), along, sideways, across: new Vector3().crossVectors(along, sideways).normalize() };
}

// Where the camera stands, seen from the middle: parts of across, sideways and outwards.
const views: Record<ViewName, [number, number, number]> = {
  overview: [1, 0.55, 0.36],
  side: [1, 0, 0],
  front: [0, 1, 0],
  along: [0.002, 0, 1],
};
const far = 2; // m; the picture does not depend on it

export interface Room {
  left: number;
  right: number;
  top: number;
  bottom: number; // px that overlays cover
}

export class Rig {
  readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.01, 2 * far);
  readonly target = new Vector3();
  width = 1;
  height = 1;
  private halfHeight = 0.15; // m

  private known = axesOf([0, 0, 0], [0, 0, -1]);

  get axes(): Axes {
    return this.known;
  }
  set axes(axes: Axes) {
    this.known = axes;
    this.camera.up.copy(axes.along).negate();
  }

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.project();
  }

  // CSS pixels of one metre
  get scale(): number {
    return (this.height * this.camera.zoom) / (2 * this.halfHeight);
  }

  // Looks from a preset direction so that all points are in the picture, beside what overlays cover.
  look(view: ViewName, points: Vector3[], room: Room): void {
    const { axes, camera } = this;
    const [a, s, o] = views[view];
    const from = new Vector3().addScaledVector(axes.across, a).addScaledVector(axes.sideways, s).addScaledVector(axes.along, -o).normalize();
    camera.zoom = 1;
    this.target.copy(axes.entry);
    camera.position.copy(this.target).addScaledVector(from, far);
    camera.lookAt(this.target);
    camera.updateMatrixWorld();
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
    for (const point of points) {
      const p = point.clone().sub(this.target);
      box.left = Math.min(box.left, p.dot(right));
      box.right = Math.max(box.right, p.dot(right));
      box.bottom = Math.min(box.bottom, p.dot(up));
      box.top = Math.max(box.top, p.dot(up));
    }
    const inner = { width: Math.max(60, this.width - room.left - room.right), height: Math.max(60, this.height - room.top - room.bottom) };
    const metres = Math.max((box.right - box.left) / inner.width, (box.top - box.bottom) / inner.height); // a pixel
    this.halfHeight = (metres * this.height) / 2;
    const shift = new Vector3()
      .addScaledVector(right, (box.left + box.right) / 2 - (metres * (room.left - room.right)) / 2)
      .addScaledVector(up, (box.top + box.bottom) / 2 + (metres * (room.top - room.bottom)) / 2);
    this.target.add(shift);
    camera.position.add(shift);
    this.project();
  }

  zoomBy(factor: number): void {
    this.camera.zoom = Math.max(0.3, Math.min(40, this.camera.zoom * factor));
    this.project();
  }

  // CSS pixels from the upper left corner
  screen(point: Vector3): { x: number; y: number } {
    const p = point.clone().project(this.camera);
    return { x: ((p.x + 1) / 2) * this.width, y: ((1 - p.y) / 2) * this.height };
  }

  private project(): void {
    const { camera } = this;
    const aspect = this.width / this.height;
    camera.left = -this.halfHeight * aspect;
    camera.right = this.halfHeight * aspect;
    camera.top = this.halfHeight;
    camera.bottom = -this.halfHeight;
    camera.updateProjectionMatrix();
  }
}
