// SocketSource: `acus serve` at the other end of a WebSocket. A lost connection is said and taken up again.
import { readReport, type EngineClient, type Listener } from './engine_client';
import { decode } from './frame';
import type { Command } from './protocol';

const firstWait = 500; // ms
const longestWait = 5000;
const betweenHolds = 250; // ms, at which a page that leads says so

export class SocketSource implements EngineClient {
  readonly kind = 'serve';
  private socket: WebSocket | null = null;
  private listener: Listener | null = null;
  private wait = firstWait;
  private timer = 0;
  private holding = 0;
  private closed = false;

  constructor(private readonly address: string) {}

  connect(listener: Listener): void {
    this.listener = listener;
    listener.link('connecting', 'Connecting to acus serve.');
    this.open();
  }

  send(command: Command): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    this.socket.send(JSON.stringify(command));
    // From its first command on it leads, and says so, until another one does.
    if (command.type !== 'check' && command.type !== 'hold' && this.holding === 0)
      this.holding = window.setInterval(() => this.send({ type: 'hold' }), betweenHolds);
  }

  private letGo(): void {
    clearInterval(this.holding);
    this.holding = 0;
  }

  close(): void {
    this.closed = true;
    clearTimeout(this.timer);
    this.letGo();
    this.socket?.close();
  }

  private open(): void {
    const listener = this.listener!;
    const socket = new WebSocket(this.address);
    let reached = false;
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = firstWait;
      reached = true;
      listener.link('open', 'Connected to acus serve.');
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === 'string') {
        const report = readReport(data);
        if (report?.type === 'loop' && !report.owner) this.letGo();
        if (report) listener.report(report);
      } else {
        const frame = decode(data);
        if (frame) listener.frame(frame);
      }
    };
    socket.onclose = () => {
      this.letGo();
      void this.lost(reached);
    };
  }

  private async lost(reached: boolean): Promise<void> {
    const words = reached ? 'The connection to acus serve is lost; trying again. Nothing pushes the needle meanwhile.' : await whyUnreached();
    if (this.closed) return this.listener!.link('closed', 'The connection was closed.');
    this.listener!.link('lost', words);
    this.timer = window.setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(longestWait, this.wait * 2);
  }
}

// A refused socket gives no reason. A server that gives its page, and not its socket, was not told its token.
async function whyUnreached(): Promise<string> {
  const answers = await fetch(location.href, { cache: 'no-store', signal: AbortSignal.timeout(2000) }).then(({ ok }) => ok, () => false);
  return answers
    ? 'acus serve was started again and does not know this page any more: open the address that it printed last, in its terminal.'
    : 'acus serve does not answer; trying again. Is it still running in its terminal?';
}
