// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/mesh_tolerance.h>

namespace SlipStep
{
  MeshTolerance::MeshTolerance(const RefinementParameters &refinement)
    : refinement(refinement)
  {
    if (refinement.type == RefinementType::adaptive)
      record.tolerance = refinement.tolerance;
  }



  void MeshTolerance::add(const double time, const MarkedCells &marked)
  {
    ++record.n_checked;
    record.last = marked.error;
    if (marked.error > record.largest)
      {
        record.largest         = marked.error;
        record.time_of_largest = time;
      }
    if (marked.error <= record.tolerance * (1. + MarkedCells::slack))
      return;
    ++record.n_missed;
    ++(marked.n_too_many > 0. ? by_cells :
       marked.n_refined > 0   ? by_repeats :
                                by_levels);
  }



  std::string MeshTolerance::remedy() const
  {
    std::string text;
    const auto  add = [&text](const unsigned long long n,
                             const std::string       &limit) {
      if (n > 0)
        text += (text.empty() ? "" : ", ") + limit + " (" + std::to_string(n) +
                (n == 1 ? " step)" : " steps)");
    };
    add(by_levels,
        "'Refinement = adaptive " + std::to_string(refinement.levels) +
          "' allows no finer cells");
    add(by_cells, "'Most cells' or 'Most memory' allows no more of them");
    add(by_repeats, "'Most repeats' allowed no further repeat");
    return text;
  }
} // namespace SlipStep
