// The needle: a tube of true thickness along the line that the engine sends, an outline of constant width on the
// screen so that it is seen from afar, its hub and its tip.
import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DynamicDrawUsage,
  Group,
  LatheGeometry,
  Mesh,
  MeshStandardMaterial,
  ShaderMaterial,
  Vector2,
  Vector3,
} from 'three';

const sides = 10;

const outlineVertex = `
  uniform vec2 size; // px of what is drawn into
  uniform float width; // px
  void main() {
    vec4 place = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    vec3 out3 = normalize(normalMatrix * normal);
    vec2 side = length(out3.xy) > 1e-4 ? normalize(out3.xy) : vec2(0.0);
    place.xy += side * width * 2.0 / size * place.w;
    gl_Position = place;
  }`;
const outlineFragment = `
  uniform vec3 colour;
  void main() { gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
  }`;

export class Needle {
  readonly group = new Group();
  readonly hub = new Group();
  private readonly tube = new BufferGeometry();
  private readonly steel = new MeshStandardMaterial({ metalness: 0.35, roughness: 0.35 });
  private readonly hubMaterial = new MeshStandardMaterial({ metalness: 0, roughness: 0.5 });
  private readonly outline = new ShaderMaterial({
    uniforms: { size: { value: new Vector2(1, 1) }, width: { value: 1.2 }, colour: { value: new Color(0) } },
    vertexShader: outlineVertex,
    fragmentShader: outlineFragment,
    side: BackSide,
  });
  private points = 0;

  constructor(
    private readonly radius: number,
    private readonly along: Vector3, // unit, into the tissue
  ) {
    for (const [material, order] of [
      [this.outline, 0],
      [this.steel, 1],
    ] as const) {
      const mesh = new Mesh(this.tube, material);
      mesh.renderOrder = order;
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
    this.buildHub();
    this.group.add(this.hub);
  }

  // A Luer hub, its mouth where the needle is held: millimetres from there, outwards.
  private buildHub(): void {
    const mm = 1e-3;
    const outlineOf = [
      [0.0, 0], [1.1, 0], [1.6, 4], [2.0, 9], [3.1, 10], [3.1, 22], [3.9, 22.4], [3.9, 24], [0, 24],
    ].map(([r, z]) => new Vector2(r! * mm, z! * mm));
    const body = new Mesh(new LatheGeometry(outlineOf, 28), this.hubMaterial);
    for (let k = 0; k < 3; ++k) {
      const rib = new Mesh(new CylinderGeometry(3.5 * mm, 3.5 * mm, 1.1 * mm, 28), this.hubMaterial);
      rib.position.y = (13 + 3 * k) * mm;
      this.hub.add(rib);
    }
    this.hub.add(body);
    this.hub.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), this.along.clone().negate());
  }

  style(steel: string, outline: string, hub: string): void {
    this.steel.color = new Color(steel);
    this.hubMaterial.color = new Color(hub);
    (this.outline.uniforms.colour!.value as Color).set(outline);
  }

  held(held: boolean): void {
    this.hubMaterial.emissive = new Color(held ? 0x24507a : 0);
  }

  // px of what is drawn into, and of the outline
  fit(width: number, height: number, outline: number): void {
    (this.outline.uniforms.size!.value as Vector2).set(width, height);
    this.outline.uniforms.width!.value = outline;
  }

  draw(line: Float32Array): void {
    const n = line.length / 3;
    if (n < 2) return;
    if (n !== this.points) this.allocate(n);
    const position = this.tube.getAttribute('position') as BufferAttribute;
    const normal = this.tube.getAttribute('normal') as BufferAttribute;
    const here = new Vector3();
    const tangent = new Vector3();
    const side = new Vector3();
    const other = new Vector3();
    const radial = new Vector3();
    const at = (i: number, out: Vector3) => out.set(line[3 * i]!, line[3 * i + 1]!, line[3 * i + 2]!);
    for (let i = 0; i < n; ++i) {
      at(Math.min(n - 1, i + 1), tangent).sub(at(Math.max(0, i - 1), here)).normalize();
      at(i, here);
      // The bow lies in a plane, whose normal serves all along the needle.
      other.set(0, 1, 0).addScaledVector(tangent, -tangent.y);
      if (other.lengthSq() < 1e-6) other.set(1, 0, 0);
      other.normalize();
      side.crossVectors(other, tangent);
      const radius = i === n - 1 ? 0 : this.radius; // the last ring closes in the tip
      for (let k = 0; k < sides; ++k) {
        const angle = (2 * Math.PI * k) / sides;
        radial.copy(side).multiplyScalar(Math.cos(angle)).addScaledVector(other, Math.sin(angle));
        normal.setXYZ(i * sides + k, radial.x, radial.y, radial.z);
        position.setXYZ(i * sides + k, here.x + radius * radial.x, here.y + radius * radial.y, here.z + radius * radial.z);
      }
    }
    position.needsUpdate = normal.needsUpdate = true;
    at(0, this.hub.position);
  }

  private allocate(n: number): void {
    this.points = n;
    const index: number[] = [];
    for (let i = 0; i + 1 < n; ++i)
      for (let k = 0; k < sides; ++k) {
        const [a, b] = [i * sides + k, i * sides + ((k + 1) % sides)];
        index.push(a, b, a + sides, b, b + sides, a + sides);
      }
    this.tube.dispose();
    this.tube.setIndex(index);
    for (const name of ['position', 'normal'])
      this.tube.setAttribute(name, new BufferAttribute(new Float32Array(3 * n * sides), 3).setUsage(DynamicDrawUsage));
  }

  dispose(): void {
    this.tube.dispose();
    for (const material of [this.steel, this.outline, this.hubMaterial]) material.dispose();
  }
}
