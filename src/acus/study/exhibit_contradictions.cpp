// Where the paper contradicts itself, in plain words, with the numbers worked out from the closed forms.
#include "acus/needle/buckling.h"
#include "acus/needle/needle_spec.h"
#include "acus/sim/prediction.h"
#include "acus/study/exhibits.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

using needle::Support;

std::string load(double length, Support support) {
  return number(needle::critical_load(needle::bending_rigidity(needle::NeedleSpec{}), length, support), 3);
}

// Largest load of the clamped-pinned elastica over its critical load, however far its ends come together.
double greatest_clamped_pinned_ratio() {
  Scene scene;
  scene.tissue.rigid = true;
  scene.needle.support = Support::clamped_pinned;
  scene.hand.travel = scene.needle.length;
  const Prediction prediction = predict(scene);
  return prediction.highest_load / prediction.critical_load;
}

// Which studies used the linear tetrahedron, and what that means; empty when none did.
std::string locking(const std::vector<GroupRecords>& groups) {
  std::string linear;
  bool all = true;
  for (const GroupRecords& group : groups) {
    bool some = false;
    for (const RunRecord& run : group.runs) {
      if (run.scene.tissue.rigid) continue;
      const bool is_linear = run.scene.tissue.element == Element::linear;
      some = some || is_linear;
      all = all && is_linear;
    }
    if (some) linear += joined({linear.empty() ? "" : ", ", group.group->name});
  }
  if (linear.empty()) return {};
  return joined(
      {all ? "These studies" : joined({"Runs of ", linear}),
       " use the paper's linear tetrahedron. At Poisson's ratio 0.48 it is too stiff (it locks), so "
       "dents before puncture come out too shallow on coarse meshes. Critical loads hardly depend on "
       "it. Scenes that do not ask for it get an element that does not lock."});
}

void say_supports(Page& page) {
  const double greatest_ratio = greatest_clamped_pinned_ratio();
  page.heading(3, "contradiction-supports", "Fig. 7(a) does not follow from Eq. 10");
  page.paragraphs(
      joined({"Eq. 10 is Euler's formula for a needle whose two ends are free to turn. With the needle of "
              "Table I it gives ",
              load(0.15, Support::pinned_pinned), ", ", load(0.2, Support::pinned_pinned), " and ",
              load(0.3, Support::pinned_pinned),
              " N at 150, 200 and 300 mm. All are below the rupture force of 1.0 N, so by Eq. 10 all three "
              "needles must buckle; yet Fig. 7(a) "
              "shows the 150 mm needle going in without buckling.\n\nA hand that holds the hub does not let "
              "it turn. Clamped at the hub and resting "
              "in the tissue at the tip, the same needle carries ",
              load(0.15, Support::clamped_pinned), ", ", load(0.2, Support::clamped_pinned), " and ",
              load(0.3, Support::clamped_pinned),
              " N, and the figure comes out: the 150 mm needle punctures first, the others buckle first. The "
              "supports are therefore part of the "
              "scene here; clamped-pinned is the default, and every study of the paper is run with both."}));
  page.heading(3, "contradiction-never", "The 200 mm needle cannot puncture at 1.0 N if pushed slowly");
  const double critical =
      needle::critical_load(needle::bending_rigidity(needle::NeedleSpec{}), 0.2, Support::clamped_pinned);
  page.paragraphs(joined(
      {"Fig. 6 and 7 show a buckled needle that later pierces the tissue. A buckled clamped-pinned "
       "needle pushes at most ",
       number(greatest_ratio, 3), " times its critical load, here ", number(greatest_ratio * critical, 2),
       " N, however far the hand goes. So with a rupture force of 1.0 N it never goes in. A needle "
       "that buckles and then punctures needs a "
       "rupture force between ",
       number(critical, 3), " and ", number(greatest_ratio * critical, 2),
       " N; the study of Fig. 6 takes one from that window and says which."}));
}

void say_formulas(Page& page) {
  page.heading(3, "contradiction-signs", "Eq. 17 and 18 do not follow from Eq. 14");
  page.paragraphs(
      "Eq. 14 says that the work of the hand goes into elastic energy and cutting: dW_e = dU + dW_c. Eq. 17 "
      "then sets the force from dW_c "
      "where dW_e is meant, and Eq. 18 subtracts dU where Eq. 14 adds it: by Eq. 18 a tissue that stores "
      "energy would pull the needle in. "
      "Both divide by the travel dx, which is zero when the hand rests.\n\nHere the hand feels the reaction "
      "at the hub, which is steady at "
      "rest. The energy force, with the signs of Eq. 14 and all terms of the ledger, is taken over a stated "
      "least travel and recorded "
      "beside it; the tables above give the largest difference.");
  page.heading(3, "contradiction-spring",
               "Eq. 8 has the node's first position where the text has its present one");
  page.paragraphs(
      "The text names x_e, the nearest node, and x_e0, its initial position; Eq. 8 and 9 use x_e0. Then the "
      "force is the stiffness k times the depth of the tip and "
      "does not depend on the tissue at all. Besides, the nearest node changes from mesh to mesh, and a "
      "force on one node has no limit when "
      "the mesh is refined: the sink of a point load grows like one over the element size.\n\nThe paper's "
      "coupling is kept under the name "
      "nearest_node. The default, embedded, acts at the needle's place inside its tetrahedron, on present "
      "positions, with equal and "
      "opposite forces, and spreads the load of the tip over a stated radius. The convergence study shows "
      "the difference.");
  page.heading(3, "contradiction-angle", "Eq. 11 is for small angles, and is used for large ones");
  page.paragraphs(
      "The sine arch of Eq. 11 with amplitude (s / pi) tan(alpha) is exact only as alpha goes to zero. At an "
      "end slope of 60 degrees it "
      "draws the bow more than a third too far out, and the curve is longer than the needle; at 90 degrees "
      "the amplitude has no limit. Eq. 12 "
      "and 13 themselves are exact. Force and shape here come from the exact elastica; the figure of the "
      "shapes shows both.");
  page.heading(3, "contradiction-crack", "A fracture toughness holds for one shape of crack only");
  page.paragraphs(
      "Eq. 16 takes the crack as a ring, 2 pi r per depth. Published values of the toughness are often "
      "worked out for a slit, 2 r. The two "
      "differ by pi, so toughness and crack shape are given together in a scene; ring is the default, as in "
      "the paper.");
}

}  // namespace

void show_contradictions(Page& page, const std::vector<GroupRecords>& groups) {
  page.heading(2, "contradictions", "Where the paper contradicts itself, and what we did");
  say_supports(page);
  say_formulas(page);
  page.heading(3, "limits", "What these results do not show");
  std::vector<std::string> limits{
      "The needle is the paper's column: it bends outside the tissue only and goes straight inside. In real "
      "tissue the inserted part is "
      "held elastically, and second buckling comes at other loads.",
      "The bow follows the elastica of the free length at every moment: the needle has mass along its axis "
      "but none across it.",
      "Rupture force, toughness and friction are single numbers for homogeneous tissue; those of living "
      "tissue scatter by tens of per cent.",
      "Nothing here was fitted to the paper's curves: it gives no tables, and its Fig. 7 has no values for "
      "friction, toughness or speed."};
  if (const std::string said = locking(groups); !said.empty()) limits.insert(limits.begin() + 1, said);
  page.list(limits);
}

}  // namespace acus::study
