// What supports the needle outside of the tissue: a collar where the hand holds it before its hub, and the guide that
// it slides in, seen through.
import { Color, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Vector3 } from 'three';
import type { Model } from '../sources/protocol';
import type { Axes } from './rig';

const mm = 1e-3;
const up = new Vector3(0, 1, 0);

const numberAt = (model: Model, table: string, key: string): number => {
  const value = model.scene[table]?.[key];
  return typeof value === 'number' ? value : 0;
};

export class Supports {
  readonly group = new Group();
  private readonly skin = new MeshStandardMaterial({ roughness: 0.6 });
  private readonly sleeve = new MeshStandardMaterial({ roughness: 0.4, transparent: true, opacity: 0.35, depthWrite: false });
  private readonly collar: Mesh | null;
  private readonly guide: Mesh | null;
  private readonly grip: number; // share of the needle's length, from the hub
  private readonly guided: { from: number; to: number }; // m above the entry

  constructor(
    model: Model,
    private readonly axes: Axes,
  ) {
    const radius = model.needle_radius_m;
    this.grip = (numberAt(model, 'hand', 'grip_mm') * mm) / model.needle_length_m;
    const gap = numberAt(model, 'guide', 'gap_mm') * mm;
    this.guided = { from: gap, to: gap + numberAt(model, 'guide', 'length_mm') * mm };
    this.collar = this.grip > 0 ? new Mesh(new CylinderGeometry(radius + 2.4 * mm, radius + 2.4 * mm, 9 * mm, 24), this.skin) : null;
    this.guide = this.guided.to > gap ? new Mesh(new CylinderGeometry(radius + 1.6 * mm, radius + 1.6 * mm, 1, 24), this.sleeve) : null;
    for (const mesh of [this.collar, this.guide]) if (mesh) this.group.add(mesh);
    this.guide?.quaternion.setFromUnitVectors(up, axes.along.clone().negate());
    this.place(this.guided.to);
  }

  style(held: string, guide: string): void {
    this.skin.color = new Color(held);
    this.sleeve.color = new Color(guide);
  }

  // `line`: points of the needle from hub to tip
  draw(line: Float32Array): void {
    const last = line.length / 3 - 1;
    const at = (i: number) => new Vector3(line[3 * i], line[3 * i + 1], line[3 * i + 2]);
    const k = Math.min(last - 1, Math.floor(this.grip * (last + 1)));
    const hand = at(k);
    if (this.collar) {
      const tangent = at(k + 1).sub(hand).normalize();
      this.collar.quaternion.setFromUnitVectors(up, tangent);
      this.collar.position.copy(hand).addScaledVector(tangent, -4.5 * mm);
    }
    // A hand that has come down to the guide has pushed it together.
    this.place(Math.min(this.guided.to, this.axes.entry.clone().sub(hand).dot(this.axes.along)));
  }

  private place(top: number): void {
    if (!this.guide) return;
    const length = Math.max(top - this.guided.from, 0.5 * mm);
    this.guide.scale.y = length;
    this.guide.position.copy(this.axes.entry).addScaledVector(this.axes.along, -(this.guided.from + length / 2));
  }

  dispose(): void {
    for (const mesh of [this.collar, this.guide]) mesh?.geometry.dispose();
    this.skin.dispose();
    this.sleeve.dispose();
  }
}
