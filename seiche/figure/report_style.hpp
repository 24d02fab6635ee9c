// The style sheet of the report: light and dark, one or two columns, and print. No fonts or pictures from elsewhere.
#pragma once

#include <string_view>

namespace seiche {

inline constexpr std::string_view report_style = R"css(
:root { color-scheme: light dark; --paper: #fdfdfc; --ink: #1b1e22; --soft: #5a6069; --line: #d9dce0; --tint: #f2f4f5;
  --link: #0b5394; --holds: #0a6644; --fails: #a8261a; --depends: #7a5600; --holds-tint: #e2f3ea; --fails-tint: #fbe6e2;
  --depends-tint: #faf0d4; }
@media (prefers-color-scheme: dark) { :root { --paper: #15181c; --ink: #e6e8ea; --soft: #a3abb4; --line: #363c44;
  --tint: #1e2329; --link: #8ec2f5; --holds: #74d8ab; --fails: #ffa193; --depends: #f0c868; --holds-tint: #123327;
  --fails-tint: #42201b; --depends-tint: #3a2f10; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); line-height: 1.5;
  font-family: system-ui, -apple-system, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; font-size: 16px; }
main { max-width: 70rem; margin: 0 auto; padding: 2.5rem 1.25rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; letter-spacing: -.01em; }
h2 { font-size: 1.35rem; line-height: 1.3; margin: 3.2rem 0 .6rem; padding-top: .9rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.02rem; margin: 1.8rem 0 .5rem; }
p, ul.text { max-width: 46rem; }
a { color: var(--link); text-underline-offset: .15em; }
.of, .source, .parameters { color: var(--soft); }
.of { margin: 0 0 1.4rem; }
.source { font-size: .85rem; }
.remark { font-size: .92rem; margin-top: .25rem; font-style: italic; }
.counts { display: flex; flex-wrap: wrap; gap: .6rem; margin: 1.2rem 0; padding: 0; list-style: none; }
.counts li { background: var(--tint); border-radius: .5rem; padding: .5rem .9rem; }
.counts b { font-size: 1.25rem; font-variant-numeric: tabular-nums; margin-right: .35rem; }
nav { font-size: .95rem; margin: 1.2rem 0; }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; }
.notice { border: 2px solid var(--depends); background: var(--depends-tint); border-radius: .5rem; padding: .7rem 1rem;
  max-width: 46rem; }
.outcome { display: inline-block; white-space: nowrap; font-weight: 600; font-size: .92rem; border-radius: .35rem;
  padding: .05rem .5rem; }
.holds { color: var(--holds); background: var(--holds-tint); }
.fails { color: var(--fails); background: var(--fails-tint); }
.depends { color: var(--depends); background: var(--depends-tint); }
.number { white-space: nowrap; }
.number sup { font-size: .75em; line-height: 0; }
.scroll { overflow-x: auto; margin: .8rem 0; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums lining-nums; width: 100%; }
th, td { padding: .35rem .6rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
thead th { font-weight: 600; border-bottom: 2px solid var(--line); vertical-align: bottom; }
tr.group th { background: var(--tint); font-size: .95rem; padding-top: .5rem; }
.verdicts td:nth-child(1) { width: 9.5rem; }
.verdicts td:nth-child(2) { width: 38%; }
.numbers { font-size: .86rem; }
.numbers td { text-align: right; white-space: nowrap; }
.numbers thead th { text-align: right; }
.numbers thead tr:first-child th:first-child { text-align: left; }
.numbers thead th[colspan="2"] { text-align: center; }
.numbers .words.words { text-align: left; white-space: normal; min-width: 16rem; }
.numbers sup { font-size: .78em; line-height: 0; }
.numbers th[colspan] { border-bottom: 1px solid var(--line); }
.numbers th[scope=row] { font-weight: 400; white-space: nowrap; }
.numbers th.proposed, .best { font-weight: 700 !important; }
.order { color: var(--soft); }
.bad { color: var(--fails); }
.notes { font-size: .88rem; padding-left: 1.2rem; }
.swatch { background: #fff; border-radius: 3px; vertical-align: -3px; margin-right: .5rem; padding: 0 1px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 1.2rem; align-items: start;
  margin: 1rem 0; }
figure { margin: 0; max-width: 34rem; }
.drawn { background: #fff; border: 1px solid var(--line); border-radius: .5rem; padding: .6rem; }
@media (prefers-color-scheme: dark) { .drawn { background: #15181c; } }
figure .files a { margin-left: .3rem; }
figure img { display: block; width: 100%; height: auto; }
figcaption { font-size: .88rem; color: var(--soft); margin-top: .4rem; }
.missing { border: 1px dashed var(--line); border-radius: .5rem; padding: 2rem 1rem; color: var(--soft); text-align: center; }
details { margin: 1rem 0; }
summary { cursor: pointer; color: var(--link); }
code { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; font-size: .9em; background: var(--tint);
  border-radius: .3rem; padding: .1rem .35rem; }
.equation { overflow-x: auto; margin: .2rem 0 1.4rem; font-size: 1.1rem; }
.narrow { width: auto; }
@media (max-width: 42rem) { .verdicts thead { display: none; } .verdicts td, .verdicts th { display: block; width: auto !important;
    border-bottom: 0; padding: .2rem .4rem; } .verdicts tr { display: block; border-bottom: 1px solid var(--line);
    padding: .4rem 0; } h1 { font-size: 1.55rem; } }
@media print { :root { color-scheme: light; --paper: #fff; --ink: #000; --soft: #444; --line: #bbb; --tint: #f3f3f3;
  --link: #000; --holds: #0a6644; --fails: #a8261a; --depends: #7a5600; --holds-tint: #fff; --fails-tint: #fff;
  --depends-tint: #fff; }
  body { font-size: 10pt; } main { max-width: none; padding: 0; } nav, details { display: none; }
  .pictures { grid-template-columns: 1fr 1fr; } figure, tr { break-inside: avoid; } h2, h3 { break-after: avoid; }
  .scroll { overflow: visible; } .numbers { font-size: 7pt; } }
)css";

// What the report of a single run adds.
inline constexpr std::string_view run_report_style = R"css(
.equation math[display="block"] { text-align: left; margin: .5rem 0; width: max-content; }
.equation .matrix { border: solid; border-width: 0 1.5px; border-radius: .7em; padding: 0 .1em; }
.equation p { margin: .5rem 0; font-size: 1rem; color: var(--soft); }
.on-dark { display: none; }
@media (prefers-color-scheme: dark) {
  .on-dark { display: block; } .on-light { display: none; } }
.drawn video, .film img { width: 100%; }
pre { background: var(--tint); border-radius: .5rem; padding: .8rem 1rem; overflow-x: auto; max-width: 46rem; }
pre code { background: none; padding: 0; }
.certificate th[scope=row] { font-weight: 600; width: 14rem; }
.certificate td:nth-child(2) { width: 13rem; }
)css";

}  // namespace seiche
