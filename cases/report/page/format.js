// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Numbers and elements of the page. Text goes into the page as text alone, never as HTML.

const $ = (id) => document.getElementById(id);

function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// Units that take a prefix, by the size of the numbers.
const prefixes = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "\u00b5"], [1e-9, "n"]];
const takesPrefix = new Set(["m", "m/s", "m/s\u00b2", "N", "N m", "J", "W", "s"]);

// {factor, unit} so that number * factor is of ordinary size.
function scaleFor(largest, unit) {
  if (!takesPrefix.has(unit) || !(largest > 0)) return {factor: 1, unit};
  for (const [size, prefix] of prefixes)
    if (largest >= size * 0.999) return {factor: 1 / size, unit: prefix + unit};
  return {factor: 1, unit};
}

function short(x, digits = 4) {
  if (x === null || !Number.isFinite(x)) return "\u2013";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-4) return x.toExponential(digits - 1);
  return String(Number(x.toPrecision(digits)));
}

function quantity(x, unit, digits = 4) {
  if (x === null || x === undefined || !Number.isFinite(x)) return "\u2013";
  const {factor, unit: scaled} = scaleFor(Math.abs(x), unit);
  return `${short(x * factor, digits)} ${scaled}`.trim();
}

const palette = ["#2f6fdb", "#d9480f", "#2b8a3e", "#9c36b5", "#c2255c", "#0c8599", "#8f6b00", "#5f3dc4", "#495057", "#e8590c"];
const colorOf = (i) => palette[i % palette.length];
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
