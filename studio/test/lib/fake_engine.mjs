// An engine that computes nothing: a small block and a needle whose numbers are made up and known, behind a
// WebSocket as `acus serve` has it. It serves the built page too.
import { WebSocketServer } from 'ws';
import { serveSite } from './site.mjs';

const length = 0.2;
const step = 1e-3; // m of travel a frame
const nodes = [];
for (const z of [0, 0.06]) for (const y of [-0.05, 0.05]) for (const x of [-0.05, 0.05]) nodes.push(x, y, z);
const tetrahedra = [0, 1, 2, 4, 3, 2, 1, 7, 5, 4, 7, 1, 6, 7, 4, 2, 1, 2, 4, 7];
const triangles = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];

const expectation = {
  words: 'buckles at 0.642 N, the tissue opens at 1.00 N: this needle will not go in',
  outcome: 'never_punctured',
  critical_load_N: 0.642,
  highest_load_N: 0.683,
  rupture_force_N: 1,
  longest_straight_m: 0.16,
};
const model = {
  type: 'model',
  scene: {
    needle: { model: 'column', length_mm: 200, radius_mm: 0.3, youngs_modulus_GPa: 200, density_kg_m3: 7850, support: 'clamped_pinned', imperfection_mm: 0.05 },
    tissue: { rigid: false, youngs_modulus_kPa: 25, tetrahedra: 1000 },
    contact: { rupture_force_N: 1, fracture_toughness_J_m2: 164, friction_N_m: 40 },
    hand: { kind: 'steady', speed_mm_s: 10, travel_mm: 40 },
  },
  scene_toml: '[needle]\nlength_mm = 200.0\n',
  time_step_s: 1e-3,
  entry_m: [0, 0, 0.06],
  direction: [0, 0, -1],
  needle_length_m: length,
  needle_radius_m: 0.3e-3,
  nodes_m: nodes,
  tetrahedra,
  triangles,
  ...expectation,
};

// The made-up numbers at a travel [m] and time [s].
export function rowAt(travel, time) {
  const buckled = travel > 8e-3;
  const force = buckled ? 0.642 + travel : (0.642 * Math.max(0, travel)) / 8e-3;
  return {
    time_s: time, hand_travel_m: travel, hand_force_N: force, energy_force_N: force, tip_force_N: force, tip_depth_m: 0.8 * Math.min(travel, 8e-3),
    inserted_length_m: 0, free_length_m: length, critical_load_N: 0.642, deflection_m: buckled ? Math.sqrt(travel * length) * 0.6 : 5e-5,
    stage: travel <= 0 ? 0 : buckled ? 2 : 1, work_hand_J: force * travel, energy_tissue_J: 0.3 * force * travel, energy_needle_J: 0.7 * force * travel,
    energy_kinetic_J: 0, work_cutting_J: 0, work_friction_J: 0, work_damping_J: 0, work_numerical_J: 0, energy_residual_J: 1.23e-9,
    solver_iterations: 12, energy_contact_J: 0, work_snap_J: 0, work_relaxation_J: 0, tip_aside_m: 0, shaft_force_N: 0,
    hub_force_x_N: 0, hub_force_y_N: 0, hub_force_z_N: 0, hub_moment_x_Nm: 0, hub_moment_y_Nm: 0, hub_moment_z_Nm: 0,
  };
}

function frameAt(row, events) {
  const points = 61;
  const count = nodes.length / 3;
  const bytes = new ArrayBuffer(272 + 12 * points + 16 * count);
  new Uint32Array(bytes, 0, 4).set([0x46434131, points, count, events]);
  new Float64Array(bytes, 16, 32).set(Object.values(row));
  const needle = new Float32Array(bytes, 272, 3 * points);
  for (let i = 0; i < points; ++i) {
    const s = i / (points - 1);
    needle.set([row.deflection_m * Math.sin(Math.PI * s), 0, 0.06 + (1 - s) * (length - row.hand_travel_m) - s * row.tip_depth_m], 3 * i);
  }
  new Float32Array(bytes, 272 + 12 * points, 3 * count).set(nodes);
  new Float32Array(bytes, 272 + 12 * (points + count), count).fill(4e3);
  return Buffer.from(bytes);
}

export const token = 'a-token-of-the-test';

// { address, commands, say(report), drop(), stop(), start() }
export async function fakeServe({ device = null, port = 0 } = {}) {
  const site = await serveSite({ port });
  const sockets = new WebSocketServer({ noServer: true });
  const commands = [];
  let now = { travel: 0, time: 0, events: 0, wanted: 0, speed: 0, paused: false, gate: 'disarmed' };
  const say = (report) => sockets.clients.forEach((client) => client.send(JSON.stringify(report)));
  const show = () => sockets.clients.forEach((client) => client.send(frameAt(rowAt(now.travel, now.time), now.events)));
  const loop = () => say({ type: 'loop', real_time_factor: 1, load: 0.31, paused: now.paused, late_ticks: 2, tick_p999_s: 2e-4, gate: now.gate, fault: '', device_force_N: now.gate === 'armed' ? 0.5 : 0, force_limit_N: 2, owner: true });

  const timer = setInterval(() => {
    if (sockets.clients.size === 0 || now.paused) return;
    if (now.speed !== 0) now.wanted = now.travel + now.speed * 0.02;
    const before = now.travel;
    now.travel += Math.max(-step, Math.min(step, now.wanted - now.travel));
    now.time += 0.02;
    const event = (name) => {
      now.events += 1;
      say({ type: 'event', time_s: now.time, event: name, hand_travel_m: now.travel, hand_force_N: rowAt(now.travel, 0).hand_force_N, free_length_m: length });
    };
    if (before <= 0 && now.travel > 0) event('contact');
    if (before <= 8e-3 && now.travel > 8e-3) event('buckling');
    show();
  }, 20);

  const acts = {
    start: ({ settings = [] }) => {
      if (settings.some((setting) => setting.startsWith('needle.radius_mm=0.1'))) return say({ type: 'refused', sentence: 'needle.radius_mm: this server refuses so thin a needle' });
      now = { ...now, travel: 0, time: 0, events: 0, wanted: 0, speed: 0, paused: false };
      say(model);
    },
    check: () => say({ type: 'expectation', ...expectation }),
    push: ({ travel_m }) => Object.assign(now, { wanted: travel_m, speed: 0 }),
    steady: ({ speed_m_s }) => Object.assign(now, { speed: speed_m_s, wanted: now.travel }),
    pause: () => (now.paused = true),
    resume: () => (now.paused = false),
    arm: () => ((now.gate = 'armed'), loop()),
    disarm: () => ((now.gate = 'disarmed'), loop()),
  };
  site.server.on('upgrade', (request, socket, head) => {
    const url = new URL(request.url, 'http://localhost');
    if (url.pathname !== '/socket' || url.searchParams.get('token') !== token) return socket.destroy();
    sockets.handleUpgrade(request, socket, head, (client) => {
      client.on('message', (text) => {
        const command = JSON.parse(text);
        commands.push(command);
        acts[command.type]?.(command);
      });
      client.send(JSON.stringify({ type: 'hello', engine: '0.1.0', source: 'serve', device, scenes: {} }));
      client.send(JSON.stringify(model));
      loop();
    });
  });
  return {
    address: `${site.address}?token=${token}`,
    port: site.server.address().port,
    commands,
    say,
    now: () => now,
    drop: () => sockets.clients.forEach((client) => client.terminate()),
    close: async () => {
      clearInterval(timer);
      sockets.clients.forEach((client) => client.terminate());
      await site.close();
    },
  };
}
