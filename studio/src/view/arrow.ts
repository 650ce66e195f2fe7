// The force on the hand as an arrow, as long as the force is large.
import { Color, ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from 'three';

const headLength = 7e-3; // m
const shaftRadius = 0.7e-3;

export class Arrow {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial({ depthTest: false });
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor(private readonly way: Vector3) {
    const shaft = new CylinderGeometry(shaftRadius, shaftRadius, 1, 12);
    shaft.translate(0, 0.5, 0);
    const head = new ConeGeometry(2.4e-3, headLength, 20);
    head.translate(0, headLength / 2, 0);
    this.shaft = new Mesh(shaft, this.material);
    this.head = new Mesh(head, this.material);
    for (const part of [this.shaft, this.head]) {
      part.renderOrder = 8;
      this.group.add(part);
    }
    this.group.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), way);
  }

  style(colour: string): void {
    this.material.color = new Color(colour);
  }

  // From `foot` outwards; a negative length [m] points back and stands behind the foot. Returns its end.
  draw(foot: Vector3, length: number): Vector3 {
    const size = Math.abs(length);
    this.group.visible = size > 1e-3;
    const shaft = Math.max(1e-4, size - headLength);
    this.shaft.scale.y = shaft;
    this.head.scale.setScalar(Math.min(1, size / headLength));
    const back = length < 0;
    this.group.position.copy(foot);
    this.head.position.y = back ? headLength * this.head.scale.y : shaft;
    this.head.rotation.x = back ? Math.PI : 0;
    this.shaft.position.y = back ? headLength : 0;
    return foot.clone().addScaledVector(this.way, size);
  }

  dispose(): void {
    this.material.dispose();
    for (const part of [this.shaft, this.head]) part.geometry.dispose();
  }
}
