// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_panel_grid_h
#define slipstep_report_panel_grid_h

#include <ostream>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Small plots side by side in one picture, with one legend on top of all.
  class PanelGrid
  {
  public:
    struct LegendEntry
    {
      std::string text;
      std::string style;           ///< of the line, as gnuplot has it
      bool        is_area = false; ///< filled with the colour of the style
    };

    /// @param row_height of a panel with its title and labels [pixel]
    PanelGrid(const std::size_t  n_panels,
              const std::size_t  most_columns,
              const unsigned int row_height);

    /// Of the whole picture [pixel].
    unsigned int height() const;

    /// Commands before the first panel.
    void begin(std::ostream                   &script,
               const std::vector<LegendEntry> &legend) const;

    /// Commands between the first panel and the second: the legend is drawn
    /// once.
    static const char *const after_first;

  private:
    std::size_t  n_columns;
    std::size_t  n_rows;
    unsigned int row_height;
  };

  /// A gnuplot command with some four round numbers on the axis, so that their
  /// texts keep apart: powers of ten and their 2 and 5 on a logarithmic one.
  std::string few_tics(const char   axis,
                       const double lower,
                       const double upper,
                       const bool   is_logarithmic);
} // namespace SlipStep

#endif
