// Usage: node embed.mjs PAGE.html FUNCTION OUT.cpp
// Turns the page into a C++ source that defines ballbot::FUNCTION().
import { readFileSync, writeFileSync } from 'node:fs';

const [page, name, out] = process.argv.slice(2);

// Every byte outside printable ASCII is written as three octal digits, which end by themselves.
function literal(bytes) {
  let text = '';
  for (const byte of bytes) {
    const plain = byte >= 0x20 && byte < 0x7f && byte !== 0x22 && byte !== 0x5c && byte !== 0x3f;
    text += plain ? String.fromCharCode(byte) : '\\' + byte.toString(8).padStart(3, '0');
  }
  return `    "${text}"`;
}

const bytes = readFileSync(page);
const lineLength = 4000;
const lines = [];
for (let i = 0; i < bytes.length; i += lineLength) {
  lines.push(literal(bytes.subarray(i, i + lineLength)));
}
writeFileSync(
  out,
  `// Made by viewer/scripts/embed.mjs from a page of viewer/.
#include "report/page_template.hpp"

namespace ballbot {

const std::string& ${name}() {
  static const char text[] =
${lines.join('\n')};
  static const std::string page(text, sizeof text - 1);
  return page;
}

}  // namespace ballbot
`,
);
