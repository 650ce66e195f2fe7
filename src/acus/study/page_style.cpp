// How a report looks: one column of calm text, wide figures, both colour schemes, and print.
#include "acus/study/page.h"

namespace acus::study {

std::string page_style() {
  return R"css(:root{--paper:#fff;--ink:#1c1e21;--soft:#5a6068;--grid:#e3e6ea;--link:#0062a8;--panel:#f6f7f9}
@media (prefers-color-scheme:dark){:root{--paper:#15181c;--ink:#e8eaed;--soft:#a7aeb7;--grid:#2c3138;--link:#5db3f5;--panel:#1c2026}}
*{box-sizing:border-box}
html{background:var(--paper);color:var(--ink);font:16px/1.55 system-ui,"Segoe UI","Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
body{margin:0}
main{max-width:1080px;margin:0 auto;padding:2.5rem 1.5rem 5rem}
h1{font-size:2rem;line-height:1.2;margin:0 0 1.25rem;letter-spacing:-.01em;max-width:26em}
h2{font-size:1.4rem;line-height:1.3;margin:3.5rem 0 .6rem;padding-top:1rem;border-top:1px solid var(--grid)}
h3{font-size:1.08rem;margin:2rem 0 .4rem}
p,ul{max-width:46rem;margin:.6rem 0}
li{margin:.3rem 0}
a{color:var(--link)}
.note{color:var(--soft);font-size:.88rem}
nav{background:var(--panel);border-radius:6px;padding:.6rem 1.2rem;margin:1.2rem 0 1.6rem;max-width:46rem}
nav ol{margin:0;padding-left:1.4rem}nav li{margin:.15rem 0}
figure{margin:1.6rem 0;break-inside:avoid}
figure svg{display:block;width:100%;height:auto}
figcaption{color:var(--soft);font-size:.9rem;max-width:46rem;margin-top:.4rem}figcaption b{color:var(--ink);font-weight:600}
.row{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,490px),1fr));gap:0 1.6rem;align-items:start}
.row figure{margin:.8rem 0}
details{margin:.5rem 0;font-size:.9rem}summary{cursor:pointer;color:var(--link)}
summary:focus-visible,a:focus-visible{outline:2px solid var(--link);outline-offset:2px;border-radius:2px}
.scroll{overflow-x:auto;margin:1rem 0}
table{border-collapse:collapse;font-size:.87rem;font-variant-numeric:tabular-nums}
.wide{font-size:.74rem}.wide th,.wide td{padding-right:.5rem}
caption{text-align:left;color:var(--soft);padding-bottom:.4rem;font-size:.9rem}
th,td{padding:.32rem .8rem .32rem 0;text-align:left;border-bottom:1px solid var(--grid);vertical-align:top}
thead th{border-bottom:1.5px solid var(--soft);font-weight:600;vertical-align:bottom}
tbody th{font-weight:400;white-space:nowrap}thead th.number{white-space:normal}
.number{text-align:right;white-space:nowrap}
@media print{:root{--paper:#fff;--ink:#000;--soft:#444;--grid:#ccc;--link:#000;--panel:#fff}
html{font-size:10.5pt}main{max-width:none;padding:0}nav,details{display:none}h2{margin-top:1.6rem;break-after:avoid}h3{break-after:avoid}
.row{grid-template-columns:1fr 1fr;gap:0 .8rem}tr{break-inside:avoid}.scroll{overflow:visible}table,.wide{font-size:7.4pt}th,td{padding:.2rem .45rem .2rem 0}tbody th{white-space:normal;overflow-wrap:anywhere}@page{margin:16mm 15mm}}
)css";
}

}  // namespace acus::study
