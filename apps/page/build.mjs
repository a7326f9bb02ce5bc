// Bundles the page and writes it as a C++ source: node build.mjs page_program.cpp. With a second file also the parts as JSON.

import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
import { build } from "esbuild";

const digest = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const bundled = await build({
  entryPoints: ["src/main.tsx"],
  outfile: "page.js",
  bundle: true,
  write: false,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "ascii",
  legalComments: "none",
  preserveSymlinks: true,
  jsx: "automatic",
  jsxImportSource: "preact",
  define: { "process.env.NODE_ENV": '"production"' },
  loader: { ".css": "css" },
  logLevel: "warning",
});
const text = (ending) => bundled.outputFiles.find((file) => file.path.endsWith(ending)).text.trim();
// Nothing in a script may end it.
const script = text(".js").replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const style = text(".css");

// Licences of what is in the bundle: their text has to go with it.
const notice = `/* avoidbench's page, with three.js, preact and fflate, each under the MIT licence:
Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the "Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the following conditions: The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
three.js (c) 2010-2026 three.js authors; preact (c) 2015-present Jason Miller; fflate (c) Arjun Barrett */`;
const whole = `${notice}\n${script}\n`;

const policy = [
  `default-src 'none'`,
  `script-src ${digest(whole)}`,
  `style-src ${digest(style)}`,
  `img-src data: blob:`,
  `base-uri 'none'`,
  `form-action 'none'`,
].join("; ");

const parts = {
  head: `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<link rel="icon" href="data:,">
<title>`,
  body: ` · avoidbench</title>
<style>${style}</style>
</head>
<body>
<div id="app"><p class="loading">Loading …</p></div>
<noscript><p>This page draws its charts and flights by a script, which this browser does not run.</p></noscript>
<script type="application/json" id="data">`,
  tail: `</script>
<script>${whole}</script>
</body>
</html>
`,
};

// Raw strings in pieces: compilers need not take longer ones.
const piece = 60000;
const delimiter = "avoidbench";
function literal(name, value) {
  if (value.includes(`)${delimiter}"`)) throw new Error(`${name} has the end of a raw string`);
  const pieces = [];
  for (let at = 0; at < value.length; at += piece)
    pieces.push(`R"${delimiter}(${value.slice(at, at + piece)})${delimiter}"`);
  return `const char ${name}[] =\n${pieces.join("\n")};\n`;
}
const source = `// Written by build.mjs from src/: do not edit. scripts/bundle_page.sh writes it again.
#include "page_program.hpp"

#pragma GCC diagnostic ignored "-Woverlength-strings"

namespace avoidbench {
namespace {

${literal("kHead", parts.head)}
${literal("kBody", parts.body)}
${literal("kTail", parts.tail)}
template <std::size_t size>
std::string_view text_of(const char (&text)[size]) {
  return {text, size - 1};
}

}  // namespace

PageProgram page_program() {
  return {.head = text_of(kHead), .body = text_of(kBody), .tail = text_of(kTail)};
}

}  // namespace avoidbench
`;
writeFileSync(process.argv[2], source);
if (process.argv[3]) writeFileSync(process.argv[3], JSON.stringify(parts));
console.log(`page: ${(Buffer.byteLength(parts.head + parts.body + parts.tail) / 1000).toFixed(0)} kB`);
