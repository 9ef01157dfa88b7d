// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // Levenshtein's distance, with two neighbours swapped counted as one slip
    // of the fingers.
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::vector<std::size_t>> d(
        a.size() + 1, std::vector<std::size_t>(b.size() + 1));
      for (std::size_t i = 0; i <= a.size(); ++i)
        d[i][0] = i;
      for (std::size_t j = 0; j <= b.size(); ++j)
        d[0][j] = j;
      for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j)
          {
            d[i][j] = std::min({d[i - 1][j] + 1,
                                d[i][j - 1] + 1,
                                d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
          }
      return d[a.size()][b.size()];
    }
  } // namespace



  std::string nearest_name(const std::string              &name,
                           const std::vector<std::string> &candidates)
  {
    const std::string wanted = lower_case(name);
    std::string       best;
    std::size_t       best_distance = std::string::npos;
    for (const std::string &candidate : candidates)
      {
        const std::string known = lower_case(candidate);
        const std::size_t limit =
          (std::max(wanted.size(), known.size()) + 2) / 3;
        // A name cut short, "heal", is nearer to what it begins than to "wear".
        const bool is_begun = wanted.size() > 2 && known.find(wanted) == 0;
        const std::size_t distance =
          is_begun ? 1 : edit_distance(wanted, known);
        // Of one letter for another nothing is left.
        if (distance <= limit && distance < best_distance &&
            distance < std::max(wanted.size(), known.size()))
          {
            best          = candidate;
            best_distance = distance;
          }
      }
    if (!best.empty() || wanted.size() < 3)
      return best;

    // A name cut short: "Normal" for "Normal stiffness".
    for (const std::string &candidate : candidates)
      if (lower_case(candidate).find(wanted) != std::string::npos)
        return candidate;
    return "";
  }



  std::string did_you_mean(const std::string              &name,
                           const std::vector<std::string> &candidates)
  {
    const std::string nearest = nearest_name(name, candidates);
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
  }
} // namespace SlipStep
