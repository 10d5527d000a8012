// Chromium without a window, spoken to over a pipe by its DevTools protocol.
import { spawn } from 'node:child_process';

export class Browser {
  constructor(program, profile) {
    this.process = spawn(program, ['--headless=new', '--no-sandbox', '--remote-debugging-pipe', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--window-size=1400,800', '--hide-scrollbars', '--no-first-run', '--disable-extensions',
      `--user-data-dir=${profile}`, 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.waiting = new Map();
    this.listeners = [];
    this.last = 0;
    let text = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (piece) => {
      const messages = (text + piece).split('\0');
      text = messages.pop();
      for (const message of messages) this.receive(JSON.parse(message));
    });
  }
  receive(message) {
    if (message.id === undefined) return this.listeners.forEach((listen) => listen(message));
    const { resolve, reject } = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  }
  send(method, params = {}) {
    const id = ++this.last;
    const message = { id, method, params, ...(this.session && { sessionId: this.session }) };
    this.process.stdio[3].write(`${JSON.stringify(message)}\0`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }
  // One tab, whose complaints and requests are collected.
  async open(url) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    this.session = (await this.send('Target.attachToTarget', { targetId, flatten: true })).sessionId;
    this.complaints = [];
    this.requests = [];
    this.listeners.push(({ method, params }) => {
      if (method === 'Runtime.exceptionThrown') this.complaints.push(params.exceptionDetails.exception?.description);
      if (method === 'Runtime.consoleAPICalled' && ['error', 'warning'].includes(params.type))
        this.complaints.push(params.args.map((arg) => arg.value ?? arg.description).join(' '));
      if (method === 'Log.entryAdded' && params.entry.level === 'error') this.complaints.push(params.entry.text);
      if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
    });
    for (const domain of ['Runtime', 'Log', 'Network', 'Page']) await this.send(`${domain}.enable`);
    await this.send('Page.navigate', { url });
  }
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }
  async until(expression, seconds) {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
      if (await this.evaluate(expression)) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`not within ${seconds} s: ${expression}`);
  }
  async mouse(type, x, y, buttons = 0) {
    await this.send('Input.dispatchMouseEvent', { type, x, y, button: type === 'mouseMoved' && !buttons ? 'none' : 'left', buttons, clickCount: 1 });
  }
  async click(x, y) {
    await this.mouse('mouseMoved', x, y);
    await this.mouse('mousePressed', x, y, 1);
    await this.mouse('mouseReleased', x, y);
  }
  async drag(from, to) {
    await this.mouse('mouseMoved', ...from);
    await this.mouse('mousePressed', ...from, 1);
    await this.mouse('mouseMoved', ...to, 1);
    await this.mouse('mouseReleased', ...to);
  }
  async key(key) {
    const text = key.length === 1 ? key : undefined;
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', key, text });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key });
  }
  async screenshot() {
    return Buffer.from((await this.send('Page.captureScreenshot', { format: 'png' })).data, 'base64');
  }
  async downloadTo(folder) {
    const names = new Map();
    this.downloaded = new Set();
    this.listeners.push(({ method, params }) => {
      if (method === 'Browser.downloadWillBegin') names.set(params.guid, params.suggestedFilename);
      if (method === 'Browser.downloadProgress' && params.state === 'completed') this.downloaded.add(names.get(params.guid));
    });
    const session = this.session;
    this.session = undefined;
    await this.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder, eventsEnabled: true });
    this.session = session;
  }
  // A file exists before all of it is written: done is what the browser says is done.
  async download(name, seconds) {
    for (const end = Date.now() + 1000 * seconds; !this.downloaded.has(name);) {
      if (Date.now() > end) throw new Error(`not downloaded within ${seconds} s: ${name}`);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }
  close() { this.process.kill(); }
}
