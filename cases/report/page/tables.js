// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Contacts and other events, summary, parameters, and how to make the run again.

const highestTable = 420;  // [px] of the table of contacts, as in the style
const rowHeight = 24;  // [px] of the table of contacts, of which only what is seen exists

class EventTable {
  constructor(app) {
    this.app = app;
    this.box = $("contacts");
    this.head = make("thead", {}, make("tr", {}, ...["t", "element", "region", "speed", "lasts", "peak force", "deepest", "restitution"].map((h, i) => make("th", {textContent: h, className: i === 1 || i === 2 ? "text" : ""}))));
    this.body = make("tbody");
    this.box.append(make("table", {}, this.head, this.body));
    this.box.addEventListener("scroll", () => this.draw());
  }
  load(run) {
    const impacts = run.impacts.map((i) => ({
      t: i.onset, cells: () => [quantity(i.onset, "s", 6), i.element, i.region, quantity(i.speed, "m/s"), quantity(i.release - i.onset, "s"),
        quantity(i.peak, "N"), quantity(i.deepest, "m"), i.restitution === null ? "\u2013" : short(i.restitution, 4)],
    }));
    const events = run.events.map((e) => ({t: e.t, cells: () => [quantity(e.t, "s", 6), e.element, e.region || e.kind, e.region ? e.kind : "", "", "", "", ""]}));
    this.rows = [...impacts, ...events].sort((a, b) => a.t - b.t);
    $("contacts-section").hidden = this.rows.length === 0;
    const text = `${run.impacts.length} contacts, ${run.events.length} other events. A click goes there. Restitution is the speed at release over that of approach.`;
    $("contacts-text").textContent = text;
    this.box.scrollTop = 0;
    this.current = -1;
    this.draw();
  }
  draw() {
    // Without its rows the box is not as high as it may become.
    const visible = Math.ceil(Math.max(this.box.clientHeight, highestTable) / rowHeight) + 2;
    const first = Math.max(0, Math.min(Math.floor(this.box.scrollTop / rowHeight) - 1, this.rows.length - visible));
    const rows = this.rows.slice(first, first + visible).map((row, k) => {
      const tr = make("tr", {className: first + k === this.current ? "jump now" : "jump", tabIndex: 0},
        ...row.cells().map((c, i) => make("td", {textContent: c, className: i === 1 || i === 2 ? "text" : ""})));
      tr.addEventListener("click", () => this.app.jump(row.t));
      tr.addEventListener("keydown", (e) => { if (e.key === "Enter") this.app.jump(row.t); });
      return tr;
    });
    const space = (n) => { const tr = make("tr"); tr.style.height = `${n * rowHeight}px`; return tr; };
    this.body.replaceChildren(space(first), ...rows, space(Math.max(0, this.rows.length - first - visible)));
  }
  update(t) {
    let now = -1;
    for (let low = 0, high = this.rows.length - 1; low <= high;) {
      const middle = (low + high) >> 1;
      if (this.rows[middle].t <= t) now = middle, low = middle + 1; else high = middle - 1;
    }
    if (now !== this.current) { this.current = now; this.draw(); }
  }
}

function tableOf(rows) {
  return make("table", {}, make("tbody", {}, ...rows.map(([name, value, bad]) =>
    make("tr", {}, make("td", {textContent: name}), make("td", {textContent: value, className: bad ? "bad" : ""})))));
}

function fillSummary(run) {
  const s = run.summary, box = $("summary");
  const number = (x, unit) => (typeof x === "number" ? quantity(x, unit) : "\u2013");
  const known = [["ended", s.reason], ["formulation", s.formulation], ["why", s.formulation_reason],
    ["degrees of freedom", s.degrees_of_freedom], ["steps", s.steps], ["relative tolerance", s.relative_tolerance],
    ["energy balance", number(s.energy_balance_J, "J")], ["energy exchanged", number(s.energy_exchanged_J, "J")],
    ["computing time", number(s.wall_time_s, "s")], ["rows recorded", run.recorded], ["rows in this report", run.rows]];
  const peak = Math.max(0, ...run.impacts.map((i) => i.peak));
  if (run.impacts.length) known.push(["contacts", run.impacts.length], ["peak force", quantity(peak, "N")], ["deepest", quantity(Math.max(...run.impacts.map((i) => i.deepest)), "m")]);
  const rows = known.filter(([, v]) => v !== undefined && v !== "" && v !== null).map(([n, v]) => [n, String(v)]);
  for (const note of s.notes || []) rows.push(["note", String(note)]);
  const part = (title, content) => make("div", {}, make("h3", {textContent: title}), content);
  box.replaceChildren();
  if (run.moves) box.append(part("Run", tableOf(rows)));
  const parameters = Object.entries(run.parameters || {}).map(([n, v]) => [n, String(v)]);
  if (run.law) parameters.unshift(["law", run.law]);
  if (parameters.length) box.append(part("Parameters", tableOf(parameters)));
  if (run.checks.length) box.append(part("Checks", tableOf(run.checks.map((c, i) => [String(i + 1), c.text, !c.within]))));
  const again = make("div", {}, make("pre", {textContent: run.command || `yoke view ${run.case}`}),
    make("p", {className: "hint", textContent: `Yoke ${run.yoke}. Equal inputs give equal results.`}));
  box.append(part("To make it again", again));
}

// What differs between the runs: parameters, and what came of them.
function fillComparison(runs) {
  const box = $("comparison");
  $("comparison-section").hidden = runs.length < 2;
  if (runs.length < 2) return;
  const names = [...new Set(runs.flatMap((r) => Object.keys(r.parameters || {})))];
  const differs = (values) => new Set(values).size > 1;
  const rows = [["case", runs.map((r) => r.case)], ["law", runs.map((r) => r.law || "\u2013")],
    ["formulation", runs.map((r) => r.summary.formulation)],
    ...names.map((n) => [n, runs.map((r) => String((r.parameters || {})[n] ?? "\u2013"))])].filter(([, v]) => differs(v));
  const peak = (r) => Math.max(...r.elements.contacts.map((e) => (r.column(`${e}.normal_force`) || {largest: 0}).largest), 0);
  const deepest = (r) => Math.max(...r.impacts.map((i) => i.deepest), 0);
  const measures = [["peak force", peak, "N"], ["deepest penetration", deepest, "m"], ["contacts", (r) => r.impacts.length, ""],
    ["energy exchanged", (r) => r.summary.energy_exchanged_J, "J"], ["energy balance", (r) => r.summary.energy_balance_J, "J"],
    ["steps", (r) => r.summary.steps, ""], ["computing time", (r) => r.summary.wall_time_s, "s"]];
  for (const [name, of, unit] of measures) {
    const values = runs.map(of);
    if (!values.some((v) => v > 0)) continue;
    rows.push([name, values.map((v, i) => {
      const change = i > 0 && values[0] ? ` (${v >= values[0] ? "+" : "\u2212"}${short(Math.abs(v / values[0] - 1) * 100, 3)} %)` : "";
      return quantity(v, unit) + (name === "energy balance" || name === "computing time" ? "" : change);
    })]);
  }
  const head = make("tr", {}, make("th"), ...runs.map((r) => {
    const swatch = make("span", {className: "swatch"});
    swatch.style.background = colorOf(r.index);
    return make("th", {className: "text"}, swatch, ` ${r.label}`);
  }));
  box.replaceChildren(make("table", {}, make("thead", {}, head), make("tbody", {}, ...rows.map(([n, v]) =>
    make("tr", {}, make("td", {textContent: n}), ...v.map((x) => make("td", {textContent: x, className: "text"})))))));
}
