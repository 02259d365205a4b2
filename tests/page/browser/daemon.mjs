// A cellcrushd of the test, on ports that it picks, in a folder of its own.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

export class Daemon {
  folder = mkdtempSync(join(tmpdir(), 'cellcrush-page-'));

  async start(more = []) {
    this.port ??= await freePort();
    const options = ['--data', this.folder, '--listen', 'unix:' + join(this.folder, 's'), '--workers', '1', ...more];
    this.process = spawn(process.env.CELLCRUSHD, [...options, '--http', `127.0.0.1:${this.port}`], { stdio: 'ignore' });
    for (let i = 0; i < 300; ++i) {
      const answer = await fetch(this.url).catch(() => undefined);
      if (answer?.ok) return;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    throw new Error('cellcrushd does not answer');
  }

  get url() {
    return `http://127.0.0.1:${this.port}`;
  }

  async stop(signal = 'SIGTERM') {
    if (this.process.exitCode !== null) return;
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    this.process.kill(signal);
    await ended;
  }

  async remove() {
    await this.stop();
    rmSync(this.folder, { recursive: true, force: true });
  }

  // A unary call of the API, in JSON.
  async call(method, request) {
    const answer = await fetch(`${this.url}/cellcrush.v1.${method}`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(request),
    });
    const body = await answer.json();
    if (!answer.ok) throw new Error(`${method}: ${body.message}`);
    return body;
  }

  // Waits until a job has succeeded.
  async success(name) {
    for (;;) {
      const { state } = await this.call('Jobs/GetJob', { name });
      if (state === 'SUCCEEDED') return;
      if (state !== 'PENDING' && state !== 'RUNNING') throw new Error(`${name}: ${state}`);
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }

  async presetCase(name, change = () => {}) {
    const preset = await this.call('Cases/GetPreset', { name });
    change(preset.case);
    return preset.case;
  }
}
