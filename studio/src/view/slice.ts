// Slice: geometry of a tetrahedral mesh cut by a plane. The cut is found once, in the mesh at rest; each of its
// vertices lies on an edge of the mesh and moves with it, so the cut face deforms as the tissue does.

export interface Plane {
  point: readonly [number, number, number];
  normal: readonly [number, number, number]; // what lies on its side is taken away
}

// Triangles whose vertex i is nodes a[i] and b[i], mixed by t[i].
export interface Cut {
  a: Uint32Array;
  b: Uint32Array;
  t: Float32Array;
  skin: Uint32Array; // of the surface that is left
  face: Uint32Array; // of the cut face
  lines: Uint32Array; // pairs: edges of the elements on the cut face and of the skin that is left
}

class Vertices {
  a: number[] = [];
  b: number[] = [];
  t: number[] = [];
  private found = new Map<number, number>();

  constructor(
    private readonly count: number,
    private readonly distance: Float64Array,
  ) {}

  node(i: number): number {
    return this.take(i, i, 0);
  }

  crossing(i: number, j: number): number {
    const [low, high] = i < j ? [i, j] : [j, i];
    const d = this.distance[low]! - this.distance[high]!;
    return this.take(low, high, d === 0 ? 0.5 : this.distance[low]! / d);
  }

  private take(a: number, b: number, t: number): number {
    const key = a * this.count + b;
    let index = this.found.get(key);
    if (index === undefined) {
      index = this.a.push(a) - 1;
      this.b.push(b);
      this.t.push(t);
      this.found.set(key, index);
    }
    return index;
  }
}

// Signed distances, never zero: a node on the plane counts as just behind it.
function distances(nodes: ArrayLike<number>, plane: Plane | null): Float64Array {
  const out = new Float64Array(nodes.length / 3).fill(-1);
  if (!plane) return out;
  const [px, py, pz] = plane.point;
  const [nx, ny, nz] = plane.normal;
  const least = 1e-9; // m
  for (let i = 0; i < out.length; ++i) {
    const d = (nodes[3 * i]! - px) * nx + (nodes[3 * i + 1]! - py) * ny + (nodes[3 * i + 2]! - pz) * nz;
    out[i] = Math.abs(d) < least ? -least : d;
  }
  return out;
}

export function cut(nodes: ArrayLike<number>, tetrahedra: ArrayLike<number>, triangles: ArrayLike<number>, plane: Plane | null): Cut {
  const distance = distances(nodes, plane);
  const vertices = new Vertices(distance.length, distance);
  const skin: number[] = [];
  const face: number[] = [];
  const lines: number[] = [];
  for (let i = 0; i < triangles.length; i += 3) clip([triangles[i]!, triangles[i + 1]!, triangles[i + 2]!], distance, vertices, skin, lines);
  if (plane) for (let i = 0; i < tetrahedra.length; i += 4) slice(tetrahedra, i, distance, vertices, face, lines);
  return {
    a: Uint32Array.from(vertices.a),
    b: Uint32Array.from(vertices.b),
    t: Float32Array.from(vertices.t),
    skin: Uint32Array.from(skin),
    face: Uint32Array.from(face),
    lines: Uint32Array.from(lines),
  };
}

// What of one surface triangle lies behind the plane.
function clip(corners: [number, number, number], distance: Float64Array, vertices: Vertices, skin: number[], lines: number[]): void {
  const polygon: number[] = [];
  for (let k = 0; k < 3; ++k) {
    const here = corners[k]!;
    const next = corners[(k + 1) % 3]!;
    const behind = distance[here]! < 0;
    if (behind) polygon.push(vertices.node(here));
    if (behind !== distance[next]! < 0) polygon.push(vertices.crossing(here, next));
  }
  fan(polygon, skin, lines);
}

// The triangle or quadrangle in which the plane cuts one tetrahedron.
function slice(tetrahedra: ArrayLike<number>, first: number, distance: Float64Array, vertices: Vertices, face: number[], lines: number[]): void {
  const behind: number[] = [];
  const before: number[] = [];
  for (let k = 0; k < 4; ++k) (distance[tetrahedra[first + k]!]! < 0 ? behind : before).push(tetrahedra[first + k]!);
  if (behind.length === 0 || before.length === 0) return;
  const polygon =
    behind.length === 2
      ? [
          vertices.crossing(behind[0]!, before[0]!),
          vertices.crossing(behind[0]!, before[1]!),
          vertices.crossing(behind[1]!, before[1]!),
          vertices.crossing(behind[1]!, before[0]!),
        ]
      : behind.length === 1
        ? before.map((node) => vertices.crossing(behind[0]!, node))
        : behind.map((node) => vertices.crossing(node, before[0]!));
  fan(polygon, face, lines);
}

function fan(polygon: number[], triangles: number[], lines: number[]): void {
  for (let k = 2; k < polygon.length; ++k) triangles.push(polygon[0]!, polygon[k - 1]!, polygon[k]!);
  if (polygon.length > 2) for (let k = 0; k < polygon.length; ++k) lines.push(polygon[k]!, polygon[(k + 1) % polygon.length]!);
}

// values at the nodes, `width` a node, mixed into the vertices of the cut.
export function mixInto(out: Float32Array, values: ArrayLike<number>, width: number, { a, b, t }: Cut): void {
  for (let i = 0; i < a.length; ++i)
    for (let k = 0; k < width; ++k) {
      const from = values[width * a[i]! + k]!;
      out[width * i + k] = from + t[i]! * (values[width * b[i]! + k]! - from);
    }
}
