// The tissue: what is left of its surface, translucent, and the cut face through the needle, coloured by a field.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type Texture,
} from 'three';
import type { Frame } from '../sources/frame';
import type { Model } from '../sources/protocol';
import { cut, mixInto, type Cut, type Plane } from './slice';

export type Field = 'displacement' | 'stress';

export class Tissue {
  readonly group = new Group();
  private readonly geometry = { skin: new BufferGeometry(), face: new BufferGeometry(), lines: new BufferGeometry() };
  private readonly material: { skin: MeshStandardMaterial; face: MeshBasicMaterial; lines: LineBasicMaterial };
  private readonly lines: LineSegments;
  private pieces: Cut;
  private position = new BufferAttribute(new Float32Array(0), 3);
  private uv = new BufferAttribute(new Float32Array(0), 2);
  private values: Float32Array; // of the field at the nodes

  constructor(
    private readonly model: Model,
    map: Texture,
  ) {
    this.material = {
      skin: new MeshStandardMaterial({ roughness: 0.75, metalness: 0, transparent: true, opacity: 0.5, side: DoubleSide, depthWrite: false, map }),
      face: new MeshBasicMaterial({ map, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
      lines: new LineBasicMaterial({ transparent: true }),
    };
    const skin = new Mesh(this.geometry.skin, this.material.skin);
    const face = new Mesh(this.geometry.face, this.material.face);
    this.lines = new LineSegments(this.geometry.lines, this.material.lines);
    skin.renderOrder = 3;
    this.lines.renderOrder = 2;
    for (const drawn of [face, this.lines, skin]) {
      drawn.frustumCulled = false;
      this.group.add(drawn);
    }
    this.values = new Float32Array(model.nodes_m.length / 3);
    this.pieces = this.slice(null);
  }

  slice(plane: Plane | null): Cut {
    const { nodes_m, tetrahedra, triangles } = this.model;
    this.pieces = cut(nodes_m, tetrahedra, triangles, plane);
    const count = this.pieces.a.length;
    this.position = new BufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    this.uv = new BufferAttribute(new Float32Array(2 * count).fill(0.5), 2).setUsage(DynamicDrawUsage);
    for (const part of ['skin', 'face', 'lines'] as const) {
      const geometry = this.geometry[part];
      geometry.dispose();
      geometry.setIndex(new BufferAttribute(this.pieces[part], 1));
      geometry.setAttribute('position', this.position);
      if (part !== 'lines') geometry.setAttribute('uv', this.uv);
    }
    this.place(this.model.nodes_m);
    this.geometry.skin.computeVertexNormals();
    return this.pieces;
  }

  set mesh(shown: boolean) {
    this.lines.visible = shown;
  }

  style(skin: string, opacity: number, lines: string, linesOpacity: number): void {
    this.material.skin.opacity = opacity;
    this.material.skin.color = new Color(skin);
    this.material.lines.color = new Color(lines);
    this.material.lines.opacity = linesOpacity;
  }

  // Draws a frame, coloured from 0 to `most`; returns the largest value of the field.
  draw(frame: Frame, field: Field, most: number): number {
    const largest = this.measure(frame, field);
    this.place(frame.nodes);
    const one = new Float32Array(this.pieces.a.length);
    mixInto(one, this.values, 1, this.pieces);
    const uv = this.uv.array as Float32Array;
    for (let i = 0; i < one.length; ++i) uv[2 * i] = Math.min(1, one[i]! / most);
    this.uv.needsUpdate = true;
    this.geometry.skin.computeVertexNormals();
    return largest;
  }

  private measure(frame: Frame, field: Field): number {
    let largest = 0;
    const rest = this.model.nodes_m;
    const now = frame.nodes;
    for (let i = 0; i < this.values.length; ++i) {
      const value =
        field === 'stress'
          ? frame.stress[i]!
          : Math.hypot(now[3 * i]! - rest[3 * i]!, now[3 * i + 1]! - rest[3 * i + 1]!, now[3 * i + 2]! - rest[3 * i + 2]!);
      this.values[i] = value;
      if (value > largest) largest = value;
    }
    return largest;
  }

  private place(nodes: ArrayLike<number>): void {
    mixInto(this.position.array as Float32Array, nodes, 3, this.pieces);
    this.position.needsUpdate = true;
  }

  dispose(): void {
    for (const geometry of Object.values(this.geometry)) geometry.dispose();
    for (const material of Object.values(this.material)) material.dispose();
  }
}
