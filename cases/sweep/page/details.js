// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One point in words, and the points that failed.

function tableOf(pairs) {
  const body = make("tbody");
  for (const [name, value] of pairs) body.append(make("tr", {}, make("td", {textContent: name}), make("td", {textContent: value})));
  return make("table", {}, body);
}

function showPoint(sweep, row) {
  const place = $("point");
  $("point-hint").hidden = row !== null;
  $("point-title").textContent = row === null ? "Point" : `Point ${sweep.points[row]}`;
  if (row === null) return place.replaceChildren();
  const about = make("div", {}, tableOf(sweep.axes.map((a) => [a.name, a.text(a.values[row], 12)])));
  if (sweep.failed(row)) about.append(make("p", {className: "bad", textContent: sweep.reasons[row]}));
  if (sweep.commands[row]) about.append(make("p", {className: "hint", textContent: "This run alone:"}), make("pre", {textContent: sweep.commands[row]}));
  if (sweep.runs[row]) about.append(make("p", {}, make("a", {href: sweep.runs[row], textContent: "Open the report of this run"})));
  const half = (list) => tableOf(list.map((q) => [q.label, short(q.values[row], 8)]));
  place.replaceChildren(about, half(sweep.main), half(sweep.quantities.filter((q) => !sweep.main.includes(q) && q.distinct.length)));
}

function showFailures(app) {
  const {sweep} = app, failed = [];
  for (let row = 0; row < sweep.rows; ++row) if (sweep.failed(row)) failed.push(row);
  $("failures-section").hidden = failed.length === 0;
  const body = make("tbody"), most = 500;
  for (const row of failed.slice(0, most)) {
    const line = make("tr", {}, make("td", {textContent: `${sweep.points[row]}`}), make("td", {textContent: sweep.axes.map((a) => `${a.name} ${a.text(a.values[row])}`).join(", ")}), make("td", {textContent: sweep.reasons[row]}));
    line.addEventListener("click", () => app.select(row));
    body.append(line);
  }
  if (failed.length > most) body.append(make("tr", {}, make("td", {textContent: "\u2026"}), make("td"), make("td", {textContent: `${failed.length - most} more in sweep.csv`})));
  $("failures").replaceChildren(make("table", {}, body));
}
