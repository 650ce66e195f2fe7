#include "acus/needle/elastica_law.h"

#include <cassert>
#include <cmath>

#include "acus/needle/elastica.h"

namespace acus::needle {
namespace {

// The series live on -1 <= x <= 1.
double to_series(const ElasticaLaw& law, double shortening_ratio) {
  return 2.0 * shortening_ratio / law.max_shortening_ratio - 1.0;
}

numeric::ChebyshevSeries scaled(numeric::ChebyshevSeries series, double factor) {
  for (double& c : series.coefficient) c *= factor;
  return series;
}

}  // namespace

ElasticaLaw build_elastica_law(Support support) {
  ElasticaLaw law{};
  law.max_shortening_ratio = max_shortening_ratio(support);
  law.root_of_max = std::sqrt(law.max_shortening_ratio);
  const auto at = [&](double x) { return elastica(support, 0.5 * law.max_shortening_ratio * (x + 1.0)); };
  law.load = numeric::chebyshev_fit([&](double x) { return at(x).load_ratio; });
  law.energy = scaled(numeric::integral(law.load), 0.5 * law.max_shortening_ratio);
  law.root_integral = scaled(numeric::odd_integral(law.load), law.root_of_max);
  law.bow = numeric::chebyshev_fit([&](double x) {
    const Elastica e = at(x);
    return e.bow_ratio / std::sqrt(e.shortening_ratio);
  });
  return law;
}

numeric::ValueAndSlope load_ratio(const ElasticaLaw& law, double shortening_ratio) {
  assert(shortening_ratio >= 0.0);
  if (shortening_ratio > law.max_shortening_ratio) return {numeric::value(law.load, 1.0), 0.0};
  const auto [value, slope] = numeric::value_and_slope(law.load, to_series(law, shortening_ratio));
  return {value, 2.0 / law.max_shortening_ratio * slope};
}

double energy_ratio(const ElasticaLaw& law, double shortening_ratio) {
  assert(shortening_ratio >= 0.0);
  const double inside = std::fmin(shortening_ratio, law.max_shortening_ratio);
  const double beyond = shortening_ratio - inside;
  return numeric::value(law.energy, to_series(law, inside)) +
         (beyond > 0.0 ? beyond * numeric::value(law.load, 1.0) : 0.0);
}

double root_integral(const ElasticaLaw& law, double root_of_shortening_ratio) {
  assert(root_of_shortening_ratio >= 0.0);
  const double inside = std::fmin(root_of_shortening_ratio, law.root_of_max);
  const double beyond = root_of_shortening_ratio - inside;
  return numeric::odd_value(law.root_integral, inside / law.root_of_max) +
         (beyond > 0.0 ? beyond * numeric::value(law.load, 1.0) : 0.0);
}

double bow_ratio(const ElasticaLaw& law, double root_of_shortening_ratio) {
  const double root = std::fmin(root_of_shortening_ratio, law.root_of_max);
  return root * numeric::value(law.bow, to_series(law, root * root));
}

}  // namespace acus::needle
