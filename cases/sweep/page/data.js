// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The points as they stand in the page, decoded: a column for each axis and each quantity.

function decoded(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Float64Array(bytes.buffer);
}

class Column {
  constructor(json, axis) {
    Object.assign(this, {name: json.name, unit: json.unit, words: json.words || [], axis, log: json.log || false});
    this.values = decoded(json.f8);
    this.distinct = [...new Set(this.values)].filter((x) => Number.isFinite(x)).sort((a, b) => a - b);
    [this.low, this.high] = this.distinct.length ? [this.distinct[0], this.distinct[this.distinct.length - 1]] : [NaN, NaN];
  }
  // By more than rounding.
  get varies() { return this.distinct.length > 1 && (this.axis || this.high - this.low > 1e-9 * Math.max(Math.abs(this.low), Math.abs(this.high))); }
  get label() { return this.unit ? `${this.name} [${this.unit}]` : this.name; }
  text(x, digits = 5) {
    if (this.words.length) return this.words[x];
    return `${short(x, digits)} ${this.unit}`.trim();
  }
}

class Sweep {
  constructor(json) {
    Object.assign(this, json);
    this.points = decoded(json.points);
    this.axes = json.axes.map((a) => new Column(a, true));
    this.quantities = json.quantities.map((q) => new Column(q, false));
    // Of the mechanism and measures; what the solver did is shown with the point.
    const {solver_first: first, solver_count: count} = json;
    this.main = this.quantities.filter((q, k) => (k < first || k >= first + count) && q.distinct.length > 0);
    if (this.main.length === 0) this.main = this.quantities.slice(0, 1);
  }
  failed(row) { return this.reasons[row] !== ""; }
  // Every combination of the distinct values of the axes, each once.
  get isGrid() { return this.grid ??= this.axes.reduce((n, a) => n * a.distinct.length, 1) === this.rows && this.axes.every((a) => a.distinct.length < this.rows || this.axes.length === 1); }
}
