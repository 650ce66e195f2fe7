// StageView: one insertion in three dimensions on one canvas: tissue, needle, arrow, and a close-up of the entry.
import {
  AmbientLight,
  BoxGeometry,
  Color,
  DirectionalLight,
  Mesh,
  MeshStandardMaterial,
  OrthographicCamera,
  Scene,
  Vector3,
  WebGLRenderer,
  type Texture,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { place, type Frame } from '../sources/frame';
import type { Model } from '../sources/protocol';
import { Arrow } from './arrow';
import { mapTexture, paint } from './colours';
import type { Look, Marks, Point, Style } from './look';
import { Needle } from './needle';
import { axesOf, Rig, type Axes, type Room, type ViewName } from './rig';
import { Supports } from './supports';
import { Tissue } from './tissue';

export const insetSize = 150; // CSS px
export const insetHeight = 24e-3; // m
const hubLength = 24e-3;
const arrowLength = 30e-3; // m, at the force of the arrow's scale
const longestArrow = 1.4; // of that
const room: Room = { left: 24, right: 24, top: 46, bottom: 24 };

// What is made anew for each model.
interface Parts {
  model: Model;
  tissue: Tissue | null;
  wall: Mesh | null; // where there is no tissue
  needle: Needle;
  supports: Supports;
  arrow: Arrow;
  forceScale: number; // N
}

export class StageView {
  readonly rig = new Rig();
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly lamp = new DirectionalLight(0xffffff, 2.1);
  private readonly close = new OrthographicCamera(-1, 1, 1, -1, 0.01, 4);
  private readonly map: Texture = mapTexture();
  private controls: OrbitControls | null = null;
  private parts: Parts | null = null;
  private style: Style | null = null;
  private clipped = '';
  private frame: Frame | null = null;
  private view: ViewName = 'overview';
  private length = 0; // m, of needle that a preset view holds
  private turned = false; // by the person, who then keeps the view over a restart
  private arrowEnd = new Vector3();
  largest = 0; // of the field in the frame drawn last

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly changed: () => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.autoClear = false;
    this.scene.add(new AmbientLight(0xffffff, 1.5), this.lamp);
  }

  // `roomFor` m: length of needle that a preset view holds, if longer than the model's
  load(model: Model, roomFor = 0): void {
    this.clear();
    this.length = Math.max(roomFor, model.needle_length_m);
    this.rig.axes = axesOf(model.entry_m, model.direction);
    const needle = new Needle(model.needle_radius_m, this.axes.along);
    const supports = new Supports(model, this.axes);
    const arrow = new Arrow(this.axes.along.clone().negate());
    const tissue = model.nodes_m.length > 0 ? new Tissue(model, this.map) : null;
    const wall = tissue ? null : this.buildWall();
    const forceScale = Math.max(model.rupture_force_N, model.critical_load_N, 1e-3);
    this.parts = { model, tissue, wall, needle, supports, arrow, forceScale };
    this.scene.add(needle.group, supports.group, arrow.group);
    if (tissue) this.scene.add(tissue.group);
    if (wall) this.scene.add(wall);
    this.frame = null;
    this.clipped = '';
    this.controls?.dispose();
    this.controls = new OrbitControls(this.rig.camera, this.canvas);
    this.controls.target = this.rig.target;
    this.controls.enableDamping = false;
    this.controls.enableZoom = false; // the wheel pushes; see state/hand.ts
    this.controls.addEventListener('start', () => (this.turned = true));
    this.controls.addEventListener('change', this.changed);
    if (this.style) this.restyle(this.style);
    if (this.rig.width > 1 && !this.turned) this.look(this.view);
    else this.controls.update();
  }

  get axes(): Axes {
    return this.rig.axes;
  }

  private buildWall(): Mesh {
    const thick = 8e-3;
    const wall = new Mesh(new BoxGeometry(70e-3, 40e-3, thick), new MeshStandardMaterial({ roughness: 0.9 }));
    wall.position.copy(this.axes.entry).addScaledVector(this.axes.along, thick / 2);
    wall.quaternion.setFromUnitVectors(new Vector3(0, 0, -1), this.axes.along);
    return wall;
  }

  // What the picture must hold: the tissue, the whole needle with its hub, and the arrow.
  private extent(): Vector3[] {
    if (!this.parts) return [];
    const { entry, along, sideways } = this.axes;
    const { length } = this;
    const points = [entry.clone().addScaledVector(along, -(length + hubLength + 0.5 * arrowLength))];
    points.push(entry.clone().addScaledVector(along, -length / 2).addScaledVector(sideways, 0.16 * length));
    const nodes = this.parts.model.nodes_m;
    for (let i = 0; i < nodes.length; i += 3) points.push(new Vector3(nodes[i], nodes[i + 1], nodes[i + 2]));
    if (nodes.length === 0) for (const side of [-1, 1]) points.push(entry.clone().addScaledVector(sideways, 0.045 * side).addScaledVector(along, 0.012));
    return points;
  }

  resize(width: number, height: number): void {
    if (width === this.rig.width && height === this.rig.height) return;
    this.renderer.setSize(width, height, false);
    this.rig.resize(width, height);
    if (!this.turned) this.look(this.view);
  }

  look(view: ViewName): void {
    this.view = view;
    this.turned = false;
    if (!this.parts) return;
    this.rig.look(view, this.extent(), room);
    this.controls?.update();
  }

  zoom(factor: number): void {
    this.turned = true;
    this.rig.zoomBy(factor);
    this.changed();
  }

  // rad, about the direction of insertion
  turn(angle: number): void {
    this.turned = true;
    const { camera, target } = this.rig;
    camera.position.sub(target).applyAxisAngle(this.axes.along, -angle).add(target);
    this.controls?.update();
    this.changed();
  }

  restyle(style: Style): void {
    this.style = style;
    paint(this.map, style.map);
    const { parts } = this;
    parts?.needle.style(style.steel, style.outline, style.hub);
    parts?.supports.style(style.hub, style.steel);
    parts?.arrow.style(style.force);
    parts?.tissue?.style(style.skin, style.skinOpacity, style.lines, style.linesOpacity);
    if (parts?.wall) (parts.wall.material as MeshStandardMaterial).color = new Color(style.wall);
  }

  // Returns where the overlay's marks are.
  draw(frame: Frame | null, look: Look): Marks | null {
    const { parts } = this;
    if (!parts) return null;
    this.clip(parts, look);
    if (frame) {
      this.frame = frame;
      parts.needle.draw(frame.needle);
      parts.supports.draw(frame.needle);
      if (parts.tissue) {
        parts.tissue.mesh = look.mesh;
        this.largest = parts.tissue.draw(frame, look.field, look.most);
      }
      const foot = parts.needle.hub.position.clone().addScaledVector(this.axes.along, -hubLength - 1.5e-3);
      const share = Math.max(-longestArrow, Math.min(longestArrow, frame.trace[place.hand_force_N]! / parts.forceScale));
      this.arrowEnd = parts.arrow.draw(foot, arrowLength * share);
    }
    this.render(parts, look);
    return this.marks(parts, look);
  }

  private clip({ tissue }: Parts, look: Look): void {
    const key = `${look.clip} ${look.clipShift}`;
    if (!tissue || key === this.clipped) return;
    this.clipped = key;
    const { entry, across } = this.axes;
    const point = entry.clone().addScaledVector(across, look.clipShift);
    tissue.slice(look.clip ? { point: point.toArray(), normal: across.toArray() } : null);
  }

  private render({ needle, arrow }: Parts, look: Look): void {
    const { renderer, rig, lamp } = this;
    const { width, height, camera } = rig;
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    lamp.position.copy(camera.position).addScaledVector(camera.up, 1.6).addScaledVector(right, -1.1);
    lamp.target.position.copy(rig.target);
    lamp.target.updateMatrixWorld();
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
    renderer.setClearColor(0, 0);
    renderer.clear();
    needle.fit(width, height, 1.25);
    renderer.render(this.scene, camera);
    if (!look.inset || !this.style) return;
    const [x, y] = [width - insetSize - 12, 12];
    const half = insetHeight / 2;
    Object.assign(this.close, { left: -half, right: half, top: half, bottom: -half });
    const tip = this.frame ? this.entryNow() : this.axes.entry;
    this.close.position.copy(tip).add(camera.position.clone().sub(rig.target));
    this.close.quaternion.copy(camera.quaternion);
    this.close.updateProjectionMatrix();
    needle.fit(insetSize, insetSize, 1.25);
    renderer.setScissorTest(true);
    renderer.setScissor(x, y, insetSize, insetSize);
    renderer.setViewport(x, y, insetSize, insetSize);
    renderer.setClearColor(new Color(this.style.inset), 1);
    renderer.clear();
    const shown = arrow.group.visible;
    arrow.group.visible = needle.hub.visible = false;
    renderer.render(this.scene, this.close);
    arrow.group.visible = shown;
    needle.hub.visible = true;
  }

  // Near the entry, but not lower than what keeps the dent in the close-up.
  private entryNow(): Vector3 {
    const line = this.frame!.needle;
    const n = line.length;
    const tip = new Vector3(line[n - 3], line[n - 2], line[n - 1]);
    const depth = tip.sub(this.axes.entry).dot(this.axes.along);
    return this.axes.entry.clone().addScaledVector(this.axes.along, Math.max(0, Math.min(depth, 6e-3)));
  }

  private marks({ needle }: Parts, look: Look): Marks {
    const { entry, along } = this.axes;
    const hub = needle.hub.position;
    const { bow, chord } = this.bowPoints();
    const top = hub.clone().addScaledVector(along, -hubLength);
    const at = (point: Vector3) => this.rig.screen(point);
    return {
      entry: at(entry),
      target: at(entry.clone().addScaledVector(along, look.target)),
      hub: at(hub),
      hubTop: at(top),
      arrow: at(this.arrowEnd),
      bow: at(bow),
      chord: at(chord),
      scale: this.rig.scale,
    };
  }

  // The needle's drawn point farthest from its line of insertion, and the foot of that distance.
  private bowPoints(): { bow: Vector3; chord: Vector3 } {
    const { entry, along } = this.axes;
    const bow = entry.clone();
    const chord = entry.clone();
    const line = this.frame?.needle ?? new Float32Array(0);
    let most = -1;
    const p = new Vector3();
    for (let i = 0; i < line.length; i += 3) {
      p.set(line[i]!, line[i + 1]!, line[i + 2]!);
      const foot = entry.clone().addScaledVector(along, p.clone().sub(entry).dot(along));
      const off = p.distanceTo(foot);
      if (off > most) {
        most = off;
        bow.copy(p);
        chord.copy(foot);
      }
    }
    return { bow, chord };
  }

  hold(held: boolean): void {
    this.parts?.needle.held(held);
    if (this.controls) this.controls.enabled = !held;
  }

  // px on the screen for one metre of travel
  get travelOnScreen(): Point {
    const { entry, along } = this.axes;
    const a = this.rig.screen(entry);
    const b = this.rig.screen(entry.clone().addScaledVector(along, 1e-2));
    return { x: (b.x - a.x) * 100, y: (b.y - a.y) * 100 };
  }

  get pixels(): HTMLCanvasElement {
    return this.canvas;
  }

  private clear(): void {
    const { parts } = this;
    if (!parts) return;
    for (const drawn of [parts.tissue?.group, parts.wall, parts.needle.group, parts.supports.group, parts.arrow.group]) if (drawn) this.scene.remove(drawn);
    parts.tissue?.dispose();
    parts.needle.dispose();
    parts.supports.dispose();
    parts.arrow.dispose();
  }

  dispose(): void {
    this.clear();
    this.controls?.dispose();
    this.map.dispose();
    this.renderer.dispose();
  }
}
