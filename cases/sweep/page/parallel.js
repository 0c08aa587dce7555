// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Parallel coordinates: an axis for each column, a line for each point.

class Parallel {
  constructor(app) {
    this.app = app;
    this.canvas = $("parallel");
    this.drag = null;
    this.canvas.addEventListener("pointerdown", (e) => this.down(e));
    this.canvas.addEventListener("pointermove", (e) => this.move(e));
    this.canvas.addEventListener("pointerup", (e) => this.up(e));
  }
  draw() {
    const {app} = this, {g, width, height} = prepared(this.canvas), list = app.shownColumns();
    const top = 46, bottom = height - 14, side = 70;
    this.scales = list.map((c, i) => ({
      column: c, x: list.length > 1 ? side + i * (width - 2 * side) / (list.length - 1) : width / 2,
      scale: new Scale(c, bottom, top)}));
    const rows = app.rows();
    g.lineWidth = 1;
    g.globalAlpha = Math.min(0.8, Math.max(0.06, 60 / Math.sqrt(rows.length * 20)));
    for (const row of rows) this.line(g, row, app.colourOf(row));
    g.globalAlpha = 1;
    if (app.selected !== null) {
      g.lineWidth = 3.5, this.line(g, app.selected, css("--back"));
      g.lineWidth = 2, this.line(g, app.selected, css("--hot"));
    }
    this.scales.forEach((s, i) => this.axis(g, s, i, width));
  }
  line(g, row, colour) {
    g.strokeStyle = colour;
    g.beginPath();
    let drawn = false;
    for (const {column, x, scale} of this.scales) {
      const v = column.values[row];
      if (!Number.isFinite(v)) { drawn = false; continue; }
      if (drawn) g.lineTo(x, scale.place(v)); else g.moveTo(x, scale.place(v));
      drawn = true;
    }
    g.stroke();
  }
  axis(g, {column, x, scale}, i, width) {
    g.strokeStyle = css("--soft");
    g.lineWidth = 1;
    g.beginPath(), g.moveTo(x, scale.to), g.lineTo(x, scale.from), g.stroke();
    g.textBaseline = "middle";
    const last = i + 1 === this.scales.length && i > 0;
    g.textAlign = last ? "left" : "right";
    for (const t of scale.ticks()) {
      const text = scale.tickText(t), w = g.measureText(text).width, at = last ? x + 6 : x - 6;
      g.fillStyle = css("--back");
      g.globalAlpha = 0.75;
      g.fillRect(last ? at - 1 : at - w - 1, scale.place(t) - 7, w + 2, 14);
      g.globalAlpha = 1;
      g.fillStyle = css("--soft");
      g.fillText(text, at, scale.place(t));
    }
    g.textAlign = i === 0 ? "left" : last ? "right" : "center";
    g.textBaseline = "bottom";
    g.fillStyle = css("--ink");
    g.font = column.axis ? "bold 12px system-ui, sans-serif" : "12px system-ui, sans-serif";
    const at = i === 0 ? 4 : last ? width - 4 : x, low = i % 2 === 1 && this.scales.length > 4;
    g.fillText(column.label, at, low ? 34 : 18);
    g.font = "12px system-ui, sans-serif";
    const range = this.drag && this.drag.scale && this.drag.column === column ? this.drag.range : this.app.filters.get(column);
    if (!range) return;
    g.fillStyle = css("--accent");
    g.globalAlpha = 0.35;
    const [a, b] = range.map((v) => scale.place(v));
    g.fillRect(x - 7, Math.min(a, b), 14, Math.max(3, Math.abs(a - b)));
    g.globalAlpha = 1;
  }
  at(e) { const box = this.canvas.getBoundingClientRect(); return {x: e.clientX - box.left, y: e.clientY - box.top}; }
  axisNear(x) { return this.scales.find((s) => Math.abs(s.x - x) < 12); }
  down(e) {
    const p = this.at(e), near = this.axisNear(p.x);
    this.drag = {from: p, ...near, range: null};
    this.canvas.setPointerCapture(e.pointerId);
  }
  move(e) {
    if (!this.drag || !this.drag.scale) return;
    const {scale, from} = this.drag, y = this.at(e).y;
    if (Math.abs(y - from.y) < 4 && !this.drag.range) return;
    this.drag.range = [scale.number(from.y), scale.number(y)].sort((a, b) => a - b);
    this.draw();
  }
  up(e) {
    const {drag} = this;
    this.drag = null;
    if (!drag) return;
    if (drag.range) return this.app.filter(drag.column, drag.range);
    if (drag.scale && this.app.filters.has(drag.column)) return this.app.filter(drag.column, null);
    const {x, y} = this.at(e);
    this.app.select(this.nearest(x, y));
  }
  nearest(x, y) {
    const i = Math.min(Math.max(this.scales.findIndex((s) => s.x > x), 1), this.scales.length - 1);
    const a = this.scales[i - 1], b = this.scales[i] || a;
    let best = null, least = 14;
    for (const row of this.app.rows()) {
      const u = b.x > a.x ? (x - a.x) / (b.x - a.x) : 0;
      const at = a.scale.place(a.column.values[row]) * (1 - u) + b.scale.place(b.column.values[row]) * u;
      if (Math.abs(at - y) < least) { least = Math.abs(at - y); best = row; }
    }
    return best;
  }
}
