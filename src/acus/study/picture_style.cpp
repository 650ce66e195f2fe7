// The colours of every picture. Series follow Okabe and Ito's palette for colour-blind readers (2008),
// darkened on light paper and lightened on dark until text in them reaches a contrast of 4.5 to 1; each has a
// dash of its own.
#include "acus/study/svg.h"

namespace acus::study {

std::string picture_style() {
  return R"css(.picture{--paper:#fff;--ink:#1c1e21;--soft:#5a6068;--grid:#e3e6ea;--edge:#8b929b;
--s0:#0062a8;--s1:#b04a00;--s2:#00705a;--s3:#a3256b;--s4:#6b5200;--s5:#5b47b5;--s6:#3d4750;--s7:#b3202c;
--v0:#f2f5f9;--v1:#dbe6f1;--v2:#c0d5e8;--v3:#a1c1dd;--v4:#7facd1;--v5:#5d94c2;--v6:#3f7bb0;--v7:#275f96;--v8:#123f70;
font-family:system-ui,"Segoe UI","Helvetica Neue",Arial,"DejaVu Sans",sans-serif;font-size:12.5px}
@media (prefers-color-scheme:dark){.picture{--paper:#15181c;--ink:#e8eaed;--soft:#a7aeb7;--grid:#2c3138;--edge:#727a84;
--s0:#5db3f5;--s1:#f2a05b;--s2:#4bc9a8;--s3:#ec8fc0;--s4:#d8c25a;--s5:#b0a2f7;--s6:#b8c0c9;--s7:#ff8f8a;
--v0:#20262d;--v1:#22334a;--v2:#254261;--v3:#2a5378;--v4:#33668f;--v5:#437ba5;--v6:#5a92ba;--v7:#7dacce;--v8:#acd0e8}}
@media print{.picture{--paper:#fff;--ink:#000;--soft:#444;--grid:#ddd;--edge:#888;
--s0:#0062a8;--s1:#b04a00;--s2:#00705a;--s3:#a3256b;--s4:#6b5200;--s5:#5b47b5;--s6:#3d4750;--s7:#b3202c;
--v0:#f2f5f9;--v1:#dbe6f1;--v2:#c0d5e8;--v3:#a1c1dd;--v4:#7facd1;--v5:#5d94c2;--v6:#3f7bb0;--v7:#275f96;--v8:#123f70}}
.picture text{fill:var(--ink)}.picture .soft{fill:var(--soft)}.picture .strong{font-weight:600}
.picture .small{font-size:11px}.picture .heading{font-size:14px;font-weight:600}
.picture .paper{fill:var(--paper)}.picture .grid{stroke:var(--grid);stroke-width:1}
.picture .axis{stroke:var(--edge);stroke-width:1;fill:none}
.picture .curve{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
.picture .level{stroke-width:1;stroke-dasharray:2 3;fill:none}.picture .leader{stroke-width:.8;fill:none;opacity:.7}
.picture .mark{stroke:var(--paper);stroke-width:1.2}
.picture .cell{fill-opacity:.2;stroke:none}.picture .legible{paint-order:stroke;stroke:var(--paper);stroke-width:3;stroke-opacity:.75}
.picture .neutral{fill:var(--ink)}.picture .band{fill-opacity:.8;stroke:none}
.picture .tissue{stroke:none}.picture .mesh{fill:none;stroke:var(--soft);stroke-width:.45;stroke-opacity:.75;stroke-linejoin:round}
.picture .outline{fill:none;stroke:var(--ink);stroke-width:1;stroke-linecap:round}
.picture .halo{fill:none;stroke:var(--paper);stroke-linecap:round;stroke-linejoin:round}
.picture .needle{fill:none;stroke:var(--s1);stroke-linecap:butt;stroke-linejoin:round}
.picture .force{fill:var(--s7);stroke:var(--s7)}.picture text.force{stroke:none}
.picture .hub{fill:var(--soft);stroke:var(--paper);stroke-width:1}
.picture .s0{stroke:var(--s0)}.picture .s1{stroke:var(--s1);stroke-dasharray:9 3}.picture .s2{stroke:var(--s2);stroke-dasharray:3 3}
.picture .s3{stroke:var(--s3);stroke-dasharray:9 3 2 3}.picture .s4{stroke:var(--s4);stroke-dasharray:14 3}
.picture .s5{stroke:var(--s5);stroke-dasharray:2 4}.picture .s6{stroke:var(--s6);stroke-dasharray:6 2 2 2 2 2}.picture .s7{stroke:var(--s7)}
.picture .level.s0,.picture .level.s1,.picture .level.s2,.picture .level.s3,.picture .level.s4,.picture .level.s5,.picture .level.s6,.picture .level.s7{stroke-dasharray:2 3}
.picture .leader,.picture .curve.solid{stroke-dasharray:none}.picture .curve.dashed{stroke-dasharray:6 4}
.picture .f0{fill:var(--s0)}.picture .f1{fill:var(--s1)}.picture .f2{fill:var(--s2)}.picture .f3{fill:var(--s3)}
.picture .f4{fill:var(--s4)}.picture .f5{fill:var(--s5)}.picture .f6{fill:var(--s6)}.picture .f7{fill:var(--s7)}
.picture text.f0{fill:var(--s0)}.picture text.f1{fill:var(--s1)}.picture text.f2{fill:var(--s2)}.picture text.f3{fill:var(--s3)}
.picture text.f4{fill:var(--s4)}.picture text.f5{fill:var(--s5)}.picture text.f6{fill:var(--s6)}.picture text.f7{fill:var(--s7)}
.picture .v0{fill:var(--v0);stroke:var(--v0)}.picture .v1{fill:var(--v1);stroke:var(--v1)}.picture .v2{fill:var(--v2);stroke:var(--v2)}
.picture .v3{fill:var(--v3);stroke:var(--v3)}.picture .v4{fill:var(--v4);stroke:var(--v4)}.picture .v5{fill:var(--v5);stroke:var(--v5)}
.picture .v6{fill:var(--v6);stroke:var(--v6)}.picture .v7{fill:var(--v7);stroke:var(--v7)}.picture .v8{fill:var(--v8);stroke:var(--v8)}
.picture .tissue{stroke-width:.5}
)css";
}

}  // namespace acus::study
