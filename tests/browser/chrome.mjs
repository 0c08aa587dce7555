// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A headless Chromium by its own protocol, over a pipe: needs Node and Debian's chromium, no packages.
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";

export class Chrome {
  static async start(program = "chromium") {
    const chrome = new Chrome();
    // A page that hangs must not hang the test.
    chrome.watchdog = setTimeout(() => { console.log("FAILED: the browser hangs"); chrome.kill(); process.exit(1); }, 550e3);
    chrome.profile = mkdtempSync(join(tmpdir(), "yoke-chromium-"));
    chrome.process = spawn(program, ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
      "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
      "--hide-scrollbars", "--remote-debugging-pipe", `--user-data-dir=${chrome.profile}`, "about:blank"],
      {detached: true, stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});  // a group of its own
    chrome.waiting = new Map();
    chrome.messages = [];  // errors and warnings of the console
    chrome.requests = [];  // addresses asked for
    chrome.number = 0;
    let rest = "";
    chrome.process.stdio[4].setEncoding("utf8");
    chrome.process.stdio[4].on("data", (data) => {
      const parts = (rest + data).split("\0");
      rest = parts.pop();
      for (const part of parts) chrome.receive(JSON.parse(part));
    });
    const {targetInfos} = await chrome.send("Target.getTargets");
    const page = targetInfos.find((t) => t.type === "page");
    chrome.session = (await chrome.send("Target.attachToTarget", {targetId: page.targetId, flatten: true})).sessionId;
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await chrome.send(`${domain}.enable`);
    return chrome;
  }
  receive(message) {
    if (message.id) {
      const {resolve, reject} = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message)); else resolve(message.result);
      return;
    }
    const p = message.params;
    if (message.method === "Page.loadEventFired") this.loaded?.();
    if (message.method === "Network.requestWillBeSent") this.requests.push(p.request.url);
    if (message.method === "Runtime.exceptionThrown")
      this.messages.push(`exception: ${p.exceptionDetails.exception?.description || p.exceptionDetails.text}`);
    const own = JSON.stringify(p).includes("willReadFrequently");  // of the test that reads a canvas
    if (own) return;
    if (message.method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(p.type))
      this.messages.push(`${p.type}: ${p.args.map((a) => a.value ?? a.description).join(" ")}`);
    if (message.method === "Log.entryAdded" && ["error", "warning"].includes(p.entry.level))
      this.messages.push(`${p.entry.level}: ${p.entry.text}`);
  }
  send(method, params = {}) {
    const id = ++this.number;
    const text = JSON.stringify({id, method, params, ...(this.session ? {sessionId: this.session} : {})});
    this.process.stdio[3].write(text + "\0");
    return new Promise((resolve, reject) => this.waiting.set(id, {resolve, reject}));
  }
  async open(path) {
    const loaded = new Promise((resolve) => { this.loaded = resolve; });
    const began = Date.now();
    await this.send("Page.navigate", {url: `file://${path}`});
    await loaded;
    await this.evaluate("new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)))");
    return (Date.now() - began) / 1000;
  }
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.send("Runtime.evaluate", {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  }
  size(width, height) {
    return this.send("Emulation.setDeviceMetricsOverride", {width, height, deviceScaleFactor: 1, mobile: width < 500});
  }
  theme(value) { return this.send("Emulation.setEmulatedMedia", {features: [{name: "prefers-color-scheme", value}]}); }
  async mouse(type, x, y, buttons = 0, clickCount = 1) {
    await this.send("Input.dispatchMouseEvent", {type, x, y, button: type === "mouseMoved" && !buttons ? "none" : "left", buttons, clickCount});
  }
  async click(x, y, count = 1) {
    for (let i = 1; i <= count; ++i) {
      await this.mouse("mousePressed", x, y, 1, i);
      await this.mouse("mouseReleased", x, y, 0, i);
    }
  }
  async drag(x0, y0, x1, y1) {
    await this.mouse("mouseMoved", x0, y0);
    await this.mouse("mousePressed", x0, y0, 1);
    for (let i = 1; i <= 5; ++i) await this.mouse("mouseMoved", x0 + (x1 - x0) * i / 5, y0 + (y1 - y0) * i / 5, 1);
    await this.mouse("mouseReleased", x1, y1);
  }
  async key(key, code = key, text = key) {
    await this.send("Input.dispatchKeyEvent", {type: "keyDown", key, code, text});
    await this.send("Input.dispatchKeyEvent", {type: "keyUp", key, code});
  }
  async screenshot(path) {
    const {data} = await this.send("Page.captureScreenshot", {format: "png"});
    writeFileSync(path, Buffer.from(data, "base64"));
  }
  // All processes of the browser. Killed alone, the first one leaves helpers behind that still write
  // their profile while it is being removed. Returns false when none is left.
  kill() {
    try { return process.kill(-this.process.pid, "SIGKILL"); } catch { return false; }
  }
  async stop() {
    clearTimeout(this.watchdog);
    const gone = new Promise((resolve) => this.process.on("exit", resolve));
    this.kill();
    await gone;
    // What is killed is gone a moment later; a folder that stays behind is no fault of the page.
    for (let tries = 0; tries < 100; ++tries) {
      const running = this.kill();
      try { rmSync(this.profile, {recursive: true, force: true}); if (!running) return; } catch {}
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    console.log(`the browser's folder ${this.profile} could not be removed`);
  }
}
