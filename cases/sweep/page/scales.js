// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Numbers to places and to colours.

class Scale {
  // From the numbers of a column to [from, to]; words stand at equal distances.
  constructor(column, from, to, log) {
    let {low, high} = column;
    this.column = column;
    this.log = !column.words.length && (log ?? column.log) && low > 0;
    if (!(low <= high)) [low, high] = [0, 1];
    if (low === high) { const room = Math.abs(low) * 0.05 || 0.5; low -= this.log ? low * 0.05 : room; high += room; }
    if (column.words.length) { low -= 0.5; high += 0.5; }
    Object.assign(this, {low, high, from, to});
  }
  share(x) {
    return this.log ? Math.log(x / this.low) / Math.log(this.high / this.low) : (x - this.low) / (this.high - this.low);
  }
  place(x) { return this.from + this.share(x) * (this.to - this.from); }
  number(place) {
    const u = (place - this.from) / (this.to - this.from);
    return this.log ? this.low * Math.pow(this.high / this.low, u) : this.low + u * (this.high - this.low);
  }
  ticks(count = 6) {
    if (this.column.words.length) {
      const all = this.column.distinct, step = Math.ceil(all.length / 24);
      return all.filter((x, i) => i % step === 0);
    }
    if (this.log) {
      const ticks = [], decades = Math.log10(this.high / this.low);
      const within = decades > 3 ? [1] : decades > 1.2 ? [1, 3] : [1, 2, 3, 5, 7];
      for (let e = Math.floor(Math.log10(this.low)); e <= Math.log10(this.high); ++e)
        for (const m of within) { const x = Number(`${m}e${e}`); if (x >= this.low * 0.9999 && x <= this.high * 1.0001) ticks.push(x); }
      if (ticks.length > 1) return ticks;
    }
    const raw = (this.high - this.low) / count, size = Math.pow(10, Math.floor(Math.log10(raw)));
    const step = [1, 2, 5, 10].map((m) => m * size).find((s) => s >= raw * 0.999), ticks = [];
    for (let k = Math.ceil(this.low / step - 1e-9); k * step <= this.high + step * 1e-9; ++k) ticks.push(Number((k * step).toPrecision(12)));
    return ticks;
  }
  tickText(x) {
    if (!this.column.words.length) return short(x, 5).replace(/\.?0+e/, "e");
    const word = this.column.words[x];
    return word.length > 22 ? word.slice(0, 20) + "\u2026" : word;
  }
}

// Viridis, as its authors published it, at nine places.
const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
function viridisAt(u) {
  const at = Math.min(Math.max(u, 0), 1) * (viridis.length - 1), i = Math.min(Math.floor(at), viridis.length - 2);
  return `rgb(${viridis[i].map((c, k) => Math.round(c + (viridis[i + 1][k] - c) * (at - i))).join(",")})`;
}

// A canvas at the screen's resolution, cleared; lengths in CSS pixels.
function prepared(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = "12px system-ui, sans-serif";
  return {g, width, height};
}

// Frame, ticks and names of a picture over two scales.
function drawFrame(g, x, y, xName, yName) {
  const [left, right, bottom, top] = [x.from, x.to, y.from, y.to];
  g.strokeStyle = css("--grid");
  g.fillStyle = css("--soft");
  g.lineWidth = 1;
  g.textAlign = "center";
  g.textBaseline = "top";
  let free = -Infinity;
  for (const t of x.ticks()) {
    const p = x.place(t), text = x.tickText(t), half = g.measureText(text).width / 2;
    g.beginPath(), g.moveTo(p, top), g.lineTo(p, bottom), g.stroke();
    if (p - half < free) continue;
    g.fillText(text, p, bottom + 5);
    free = p + half + 6;
  }
  g.textAlign = "right";
  g.textBaseline = "middle";
  for (const t of y.ticks()) {
    const p = y.place(t);
    g.beginPath(), g.moveTo(left, p), g.lineTo(right, p), g.stroke();
    g.fillText(y.tickText(t), left - 5, p);
  }
  g.strokeStyle = css("--line");
  g.strokeRect(left, top, right - left, bottom - top);
  g.fillStyle = css("--ink");
  g.textAlign = "center";
  g.textBaseline = "bottom";
  g.fillText(xName, (left + right) / 2, bottom + 40);
  g.textAlign = "left";
  g.fillText(yName, 4, top - 6);
}

function leftMargin(g, scale) {
  return 14 + Math.max(30, ...scale.ticks().map((t) => g.measureText(scale.tickText(t)).width));
}
