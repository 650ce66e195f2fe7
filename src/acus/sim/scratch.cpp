#include "acus/sim/scratch.h"

#include "acus/sim/tissue_step.h"

namespace acus {

Scratch build_scratch(const Model& m, int threads) {
  Scratch w;
  if (m.scene.needle_model == NeedleModel::rod) {
    w.rod.motion = needle::build_rod_motion(m.rod);
    w.rod.contacts.reserve(static_cast<std::size_t>(1 + m.most_cells() + m.guide.points()));
    w.rod.free_answer.assign(m.rod.unknowns(), 0.0);
    w.rod.load = w.rod.change = w.rod.free_answer;
    w.rod.before = needle::unloaded_rod(m.rod, {});
  }
  if (m.rigid()) return w;
  w.team = Team(threads);
  w.corotation = tissue::build_corotation(
      m.tissue, single_precision_will_do(m) ? tissue::ForcePrecision::single : tissue::ForcePrecision::exact);
  w.matrix = tissue::build_system_matrix(m.tissue);
  tissue::set_factors(w.matrix, m.tissue, m.factors.mass, m.factors.stiffness);
  w.solver = numeric::RefinedScratch(m.tissue.free_nodes);
  if (m.scene.run.solver_precision == Precision::double_)
    w.exact_solver = numeric::SolveScratch<double>(m.tissue.free_nodes);
  w.coarse = numeric::build_scratch(m.coarse);
  const std::size_t size = static_cast<std::size_t>(m.tissue.free_nodes) * numeric::node_stride;
  for (numeric::NodeVector* v :
       {&w.momentum, &w.imbalance, &w.change, &w.velocity_before, &w.velocity_tried, &w.imbalance_tried})
    v->assign(size, 0.0);
  w.stick_load.assign(size, 0.0F);
  w.answer.assign(size, 0.0F);
  w.held.reserve(static_cast<std::size_t>(m.channel.cells()) + 1);
  return w;
}

}  // namespace acus
