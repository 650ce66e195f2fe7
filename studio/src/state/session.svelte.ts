// Session: what the page knows. Commands go to the engine, reports and frames come back; everything that is drawn
// is read from here.
import type { EngineClient, Link } from '../sources/engine_client';
import { place, stageOf, type Frame } from '../sources/frame';
import type { EngineEvent, EventName, Expectation, Hello, Loop, Model, Report, Stage } from '../sources/protocol';
import { Recording } from '../sources/recording';
import { RecordingSource } from '../sources/recording_source';
import { settingsList } from './choices';
import { RateMeter } from './rate_meter';
import { eventWord, labelOf } from './words';
import { millimetres, newtons } from './units';

const keptRuns = 6;
export const leastTravel = 0.01; // m, out of the tissue
const worthKeeping = 2e-3; // m of travel that make a run worth comparing
const restartAfter = 350; // ms after the last change of a choice
const serverSpeaksWithin = 1500; // ms after its hello, with the model of its own scene
const firstTouch = 0.4e-3; // m: a new insertion begins in contact

export type Settings = Record<string, number | string>;

export class Session {
  link = $state.raw<Link>('connecting');
  linkWords = $state('Loading the engine.');
  hello = $state.raw<Hello | null>(null);
  model = $state.raw<Model | null>(null);
  expectation = $state.raw<Expectation | null>(null);
  frame = $state.raw<Frame | null>(null); // what is drawn: live, or out of a recording
  events = $state.raw<EngineEvent[]>([]);
  run = $state.raw<Recording | null>(null);
  earlier = $state.raw<Recording[]>([]);
  loop = $state.raw<Loop | null>(null);
  refused = $state('');
  failed = $state('');
  said = $state(''); // the newest event, for the live region

  paused = $state(false);
  rate = $state(1);
  steadySpeed = $state(0); // m/s, 0 while the person leads
  asked = $state(0); // m, where the person wants the hand, or where it is while nobody here pushes
  starting = $state(true);
  realTimeFactor = $state(0);

  player = $state.raw<RecordingSource | null>(null);
  playing = $state(false);
  playerIndex = $state(0);

  base = ''; // the scene's TOML
  settings = $state.raw<Settings>({});
  preset = $state('');

  private engine = $state.raw<EngineClient | null>(null);
  private restart = 0;
  private runs = 0;
  private meter = new RateMeter();
  private stoppedToLook = false; // time stands still because a recording is open
  private pauses = false; // whether time stands still is as this page said, and not as the engine says
  private pushing = false; // this page gave the hand its place
  private touchDue = false; // the first touch of an insertion at a server
  onEvent: ((event: EventName) => void) | null = null;

  get stage(): Stage {
    return this.frame ? stageOf(this.frame.trace) : 'free';
  }
  get live(): boolean {
    return this.player === null;
  }
  // What the curves show: the run, or the recording that is played, up to the moment that is drawn.
  get shown(): Recording | null {
    return this.player?.recording ?? this.run;
  }
  get shownLength(): number {
    void this.frame; // with each, a recording grows
    return this.live ? (this.shown?.length ?? 0) : this.playerIndex + 1;
  }
  // A haptic device holds the hub, in real time; the page watches.
  get deviceLeads(): boolean {
    return this.hello?.source === 'serve' && this.hello.device !== null;
  }
  // The engine would do what it is told here.
  get mayLead(): boolean {
    return this.engine !== null && this.link === 'open' && this.loop?.owner !== false;
  }
  get canPush(): boolean {
    return this.mayLead && !this.deviceLeads && this.live && !this.starting && !this.failed;
  }
  get mostTravel(): number {
    if (!this.model) return 0.08;
    const own = this.model.scene.hand?.travel_mm;
    return Math.min(0.8 * this.model.needle_length_m, Math.max(0.06, typeof own === 'number' ? 1.5e-3 * own : 0));
  }

  // --- where it comes from ---------------------------------------------------------------------------------

  use(engine: EngineClient): void {
    this.engine?.close();
    this.engine = engine;
    engine.connect({
      report: (report) => this.report(report),
      frame: (frame) => this.takeFrame(frame),
      link: (link, words) => this.linked(link, words),
    });
  }

  private linked(link: Link, words: string): void {
    this.link = link;
    this.linkWords = words;
    if (link !== 'lost') return;
    this.steadySpeed = 0;
    this.pauses = false;
  }

  // A page that is a recording: nothing computes.
  show(recording: Recording): void {
    this.model = this.expectation = recording.model;
    this.run = recording;
    this.events = recording.events;
    this.starting = false;
    this.linked('open', 'A recorded insertion.');
    this.openPlayer(recording);
  }

  private report(report: Report): void {
    switch (report.type) {
      case 'hello':
        return this.greeted(report);
      case 'model':
        return this.begin(report);
      case 'expectation':
        this.expectation = report;
        this.refused = '';
        return;
      case 'event':
        return this.happened(report);
      case 'refused':
        this.refused = report.sentence;
        this.starting = false;
        return;
      case 'failed':
        this.failed = report.sentence;
        return;
      case 'loop':
        this.loop = report;
        if (!report.owner) this.pauses = this.pushing = false;
        if (!this.pauses) this.paused = report.paused;
        this.realTimeFactor = report.real_time_factor;
        this.touch();
    }
  }

  // A server may have a scene of its own; only where none comes the page's is started.
  private greeted(hello: Hello): void {
    this.hello = hello;
    if (hello.source === 'wasm') return this.start();
    this.starting = true;
    this.restart = window.setTimeout(() => this.start(), serverSpeaksWithin);
  }

  private begin(model: Model): void {
    clearTimeout(this.restart);
    this.keep();
    if (this.hello?.source === 'serve' && this.preset === '' && Object.keys(this.settings).length === 0) this.base = model.scene_toml;
    this.model = this.expectation = model;
    this.run = new Recording(model, labelOf(model), ++this.runs);
    this.events = [];
    this.frame = null;
    this.refused = this.failed = '';
    this.starting = false;
    this.steadySpeed = 0;
    this.pushing = false;
    this.meter = new RateMeter();
    if (this.rate !== 1 && !this.deviceLeads) this.engine?.send({ type: 'rate', factor: this.rate });
    if (this.paused && this.pauses) this.engine?.send({ type: 'pause' }); // a new insertion runs by itself
    this.touchDue = this.hello?.source === 'serve';
    if (!this.touchDue) this.push(firstTouch);
  }

  // At a server: not before it has said who leads, and where the hand is.
  private touch(): void {
    if (!this.touchDue || !this.loop || !this.frame) return;
    this.touchDue = false;
    if (this.loop.owner && this.frame.trace[place.hand_travel_m]! < firstTouch) this.push(firstTouch);
  }

  private keep(): void {
    const run = this.run;
    if (run && run.travelled > worthKeeping) this.earlier = [run, ...this.earlier].slice(0, keptRuns);
  }

  private takeFrame(frame: Frame): void {
    if (!this.run) return;
    this.run.add(frame);
    if (this.hello?.source !== 'serve' || !this.loop)
      this.realTimeFactor = this.meter.add(frame.trace[place.time_s]!, performance.now());
    this.stay(frame.trace[place.hand_travel_m]!);
    if (this.player) return;
    this.frame = frame;
    if (!this.pushing) this.asked = frame.trace[place.hand_travel_m]!;
    this.touch();
  }

  // The steady hand stops where the slider ends.
  private stay(travel: number): void {
    if ((this.steadySpeed > 0 && travel >= this.mostTravel) || (this.steadySpeed < 0 && travel <= -leastTravel)) this.steady(0);
  }

  private happened(event: EngineEvent): void {
    this.run?.events.push(event);
    this.events = [...this.events, event];
    this.said = `${eventWord[event.event]} at ${newtons(event.hand_force_N)}, ${millimetres(event.hand_travel_m)} of travel.`;
    this.onEvent?.(event.event);
  }

  // --- what is chosen ---------------------------------------------------------------------------------------

  chooseScene(id: string, toml: string, settings: Settings): void {
    this.preset = id;
    this.base = toml;
    this.settings = settings;
    this.start();
  }

  choose(settings: Settings): void {
    this.settings = { ...this.settings, ...settings };
    if (Object.keys(settings).some((key) => key !== 'tissue.tetrahedra')) this.preset = '';
    this.engine?.send({ type: 'check', scene: this.base, settings: settingsList(this.settings) });
    clearTimeout(this.restart);
    this.restart = window.setTimeout(() => this.start(), restartAfter);
  }

  start(): void {
    clearTimeout(this.restart);
    if (!this.engine || !this.hello) return;
    this.closePlayer();
    this.starting = true;
    if (this.paused) this.pause(false); // the old one goes on where the new one is refused
    this.asked = 0;
    this.engine.send({ type: 'start', scene: this.base, settings: settingsList(this.settings) });
  }

  // --- the run ----------------------------------------------------------------------------------------------

  push(travel: number): void {
    if (!this.canPush || !Number.isFinite(travel)) return;
    this.asked = Math.max(-leastTravel, Math.min(this.mostTravel, travel));
    this.pushing = true;
    this.steadySpeed = 0;
    this.engine?.send({ type: 'push', travel_m: this.asked });
  }

  pushBy(way: number): void {
    this.push(this.asked + way);
  }

  // Time that stands still goes on with a hand that is sent another way; a hand that is to rest needs none.
  steady(speed: number): void {
    if (!this.canPush) return;
    if (this.paused && speed !== 0 && Math.sign(speed) !== Math.sign(this.steadySpeed)) this.pause(false);
    this.steadySpeed = speed;
    this.pushing = false;
    this.engine?.send({ type: 'steady', speed_m_s: speed });
  }

  pause(paused: boolean): void {
    if (this.player) return this.play(!paused);
    if (!this.mayLead) return;
    this.paused = paused;
    this.pauses = true;
    this.engine?.send({ type: paused ? 'pause' : 'resume' });
  }

  step(steps = 1): void {
    if (this.player) {
      this.play(false);
      return this.player.send({ type: 'step', steps });
    }
    if (!this.mayLead) return;
    if (!this.paused) this.pause(true);
    this.engine?.send({ type: 'step', steps });
  }

  slow(factor: number): void {
    this.rate = factor;
    (this.player ?? this.engine)?.send({ type: 'rate', factor });
  }

  arm(armed: boolean): void {
    this.engine?.send({ type: armed ? 'arm' : 'disarm' });
  }

  // --- what was ---------------------------------------------------------------------------------------------

  openPlayer(recording: Recording | null = this.run): void {
    if (!recording || recording.length === 0 || this.player?.recording === recording) return;
    this.closePlayer();
    if (this.engine && !this.paused) {
      this.stoppedToLook = true;
      this.pause(true);
    }
    const player = new RecordingSource(recording);
    this.player = player;
    player.connect({
      report: () => {},
      link: () => {},
      frame: (frame) => {
        this.frame = frame;
        this.playerIndex = player.index;
        this.playing = player.running;
      },
    });
    player.send({ type: 'rate', factor: this.rate });
  }

  seek(index: number): void {
    this.openPlayer();
    this.play(false);
    this.player?.seek(index);
  }

  play(playing: boolean): void {
    this.openPlayer();
    this.player?.send({ type: playing ? 'resume' : 'pause' });
    this.playing = this.player?.running ?? false;
  }

  // Back to the engine, where it stood.
  closePlayer(): void {
    if (!this.player || !this.engine) return;
    const recording = this.player.recording;
    this.player.close();
    this.player = null;
    this.playing = false;
    if (recording === this.run) this.frame = recording.frame(recording.length - 1);
    if (this.stoppedToLook) this.pause(false);
    this.stoppedToLook = false;
  }
}
