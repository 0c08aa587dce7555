// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The runs as they stand in the page (cases/report/replay.hpp), decoded.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// A column decodes itself when its values are first asked for.
class Column {
  constructor(json, rows) {
    this.name = json.name;
    this.unit = json.unit;
    this.labels = json.labels || null;
    this.constant = !("f4" in json) && !("f8" in json);
    this.json = json;
    this.rows = rows;
  }
  get values() {
    if (this.decoded === undefined) {
      const {f8, f4, constant} = this.json;
      this.decoded = f8 !== undefined ? new Float64Array(bytesOf(f8))
        : f4 !== undefined ? new Float32Array(bytesOf(f4))
        : new Float64Array(this.rows).fill(constant === null ? NaN : constant);
      this.json = null;
    }
    return this.decoded;
  }
  get largest() {
    if (this.most === undefined) {
      this.most = 0;
      for (const x of this.values) if (Math.abs(x) > this.most) this.most = Math.abs(x);
    }
    return this.most;
  }
}

class Run {
  constructor(json, index) {
    Object.assign(this, json);
    this.index = index;
    this.columns = json.columns.map((c) => new Column(c, json.rows));
    this.byName = new Map(this.columns.map((c) => [c.name, c]));
    this.t = this.column("t").values;
    this.start = this.t[0];
    this.end = this.t[this.t.length - 1];
    this.label = json.label || json.law || json.case;
    // Where "next event" stops.
    this.stops = [...new Set([...this.impacts.flatMap((i) => [i.onset, i.release]),
      ...this.events.map((e) => e.t)])].sort((a, b) => a - b);
  }
  column(name) { return this.byName.get(name); }
  get box() { return this.bounds ||= boxOf(this); }
  get size() { return Math.max(this.box.right - this.box.left, this.box.top - this.box.bottom); }
  get moves() { return this.t.length > 1 && this.end > this.start; }
}

function readRuns() {
  const blocks = document.querySelectorAll("script.run");
  return Array.from(blocks, (block, index) => new Run(JSON.parse(block.textContent), index));
}
