#pragma once

namespace ballbot {

/// Style sheet of a study's page.
constexpr char kStudyStyle[] = R"css(
body { font: 15px/1.5 system-ui, sans-serif; color: #1c2430; background: #f4f6f8; margin: 0 auto; max-width: 1080px; padding: 24px; }
h1 { margin: 0; font-size: 26px; } h2 { font-size: 18px; margin: 0 0 12px; } h3 { font-size: 15px; margin: 16px 0 6px; }
header p { margin: 4px 0 0; color: #4b5868; }
section { background: #fff; border: 1px solid #dde3ea; border-radius: 8px; padding: 18px; margin: 18px 0; overflow-x: auto; }
table { border-collapse: collapse; } th, td { padding: 4px 10px; text-align: left; font-weight: normal; }
th { color: #4b5868; } .number { text-align: right; font-variant-numeric: tabular-nums; }
.heat { margin-bottom: 14px; font-variant-numeric: tabular-nums; }
.heat th + th { text-align: center; } .heat td { text-align: center; min-width: 44px; border: 2px solid #fff; color: #101820;
  background: color-mix(in srgb, #4fb07a calc(100% * var(--rate, 0)), #f0b9a6); }
.heat td.none { background: none; }
.cases { width: 100%; } .cases tbody td { border-top: 1px solid #e6ebf0; } .cases .command td { border: 0; padding-top: 0; }
code { font: 12px/1.5 ui-monospace, monospace; overflow-wrap: anywhere; color: #33414f; user-select: all; }
figure { margin: 0; } figure svg { max-width: 100%; height: auto; } figcaption { color: #4b5868; font-size: 13px; }
@media print { body { background: #fff; padding: 0; } section { break-inside: avoid; border: 0; padding: 0; } }
)css";

}  // namespace ballbot
