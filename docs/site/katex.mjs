// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Formulas to HTML: a line of JSON in, {tex, display}, a line of JSON out, {html} or {error}.
import {createInterface} from "node:readline";
import {createRequire} from "node:module";

const katex = createRequire(import.meta.url)("/usr/share/javascript/katex/katex.js");
for await (const line of createInterface({input: process.stdin})) {
  const {tex, display} = JSON.parse(line);
  let answer;
  try {
    answer = {html: katex.renderToString(tex, {displayMode: display, throwOnError: true, strict: "error"})};
  } catch (error) {
    answer = {error: String(error.message)};
  }
  process.stdout.write(JSON.stringify(answer) + "\n");
}
