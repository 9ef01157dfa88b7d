// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/page.h>
#include <slipstep/report/import_report.h>
#include <slipstep/utilities/csv.h>
#include <slipstep/measured_data/import_record.h>

namespace SlipStep
{
  namespace
  {
    void draw_curve(Page                           &page,
                    const std::string              &name,
                    const std::vector<std::string> &labels, // x and y
                    const std::vector<double>      &x,
                    const std::vector<double>      &y,
                    Gallery                        &gallery)
    {
      Rows rows;
      for (std::size_t i = 0; i < y.size(); ++i)
        if (std::isfinite(x[i]) && std::isfinite(y[i]))
          rows.push_back({x[i], y[i]});
      rows = thinned(rows);
      Range of_x, of_y;
      of_x.add(rows, 0);
      of_y.add(rows, 1);
      SmallPicture picture(page, name, labels[1] + " over " + labels[0]);
      picture.axes(labels[0], of_x, labels[1], of_y);
      picture.plot(picture.add_data(labels[1], labels, rows) +
                   " using 1:2 with lines lc rgb '" +
                   std::string(Colour::after) + "' lw 1");
      picture.finish(gallery);
    }

    // As the map converts it.
    void draw_test(Page &page, const MeasuredTest &test, Gallery &gallery)
    {
      draw_curve(page,
                 "friction",
                 {"displacement [mm]", "friction"},
                 test.displacement,
                 test.friction,
                 gallery);
      for (const Channel &channel : channels())
        if (channel.name != "time" && !(test.*channel.values).empty())
          draw_curve(page,
                     channel.name + "_over_time",
                     {"time [s]",
                      channel.name + (channel.unit.empty() ?
                                        "" :
                                        " [" + channel.unit + "]")},
                     test.time,
                     test.*channel.values,
                     gallery);
    }

    // As recorded, while nobody knows what it is.
    void
    draw_columns(Page &page, const ImportProposal &proposal, Gallery &gallery)
    {
      constexpr std::size_t most = 12;
      CsvTable              table(proposal.file, raw_format(proposal.map()));
      std::map<std::string, std::size_t> positions;
      for (const SeenColumn &column : proposal.columns)
        if (column.has_numbers && positions.size() < most)
          positions["column_" + std::to_string(column.number)] =
            column.number - 1;
      table.read(positions);
      std::vector<double> rows(table.size());
      for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = i + 1;
      for (const SeenColumn &column : proposal.columns)
        if (const std::string name = "column_" + std::to_string(column.number);
            positions.count(name) > 0)
          draw_curve(page,
                     name,
                     {"row",
                      "column " + std::to_string(column.number) +
                        (column.name.empty() ? "" : " " + column.name) +
                        (column.unit.empty() ? "" : " [" + column.unit + "]")},
                     rows,
                     table[name],
                     gallery);
    }

    std::string columns_section(const ImportProposal &proposal)
    {
      TableLines lines = {
        table_head("column | name | unit | from | to | taken as")};
      for (const SeenColumn &column : proposal.columns)
        lines.push_back(
          {std::to_string(column.number),
           column.name,
           column.unit,
           column.has_numbers ? rounded_text(column.least, 5) : "no numbers",
           column.has_numbers ? rounded_text(column.most, 5) : "",
           column.taken_as});
      return heading("The columns of the record") + html_table(lines, "values");
    }

    std::string guesses_section(const ImportProposal        &proposal,
                                const std::filesystem::path &map)
    {
      TableLines lines = {table_head("key | value | why")};
      for (const ImportGuess &guess : proposal.guesses)
        lines.push_back({guess.path,
                         guess.is_open ? "open: " + guess.value : guess.value,
                         guess.reason});
      return heading("The map") +
             note(map.string() + ". Edit it, then: slipstep import " +
                  map.string()) +
             html_table(lines, "values");
    }
  } // namespace



  std::string import_table(const ImportProposal &proposal)
  {
    std::string text;
    for (const ImportGuess &guess : proposal.guesses)
      text += std::string(guess.is_open ? "  open   " : "  taken  ") +
              guess.path + " = " + guess.value + '\n' +
              wrapped_text(guess.reason, 11, terminal_width);
    return text;
  }



  std::vector<std::string>
  write_import_report(const std::filesystem::path     &folder,
                      const ImportProposal            &proposal,
                      const std::filesystem::path     &map,
                      const std::vector<MeasuredTest> &tests,
                      const std::string               &problem)
  {
    Page    page(folder);
    Gallery gallery;
    if (tests.empty())
      {
        gallery.title   = "The columns as recorded";
        gallery.caption = "Of up to twelve columns with numbers.";
        draw_columns(page, proposal, gallery);
      }
    else
      {
        gallery.title   = "The test that the map makes of it";
        gallery.caption = "Friction is positive where it resists motion in "
                          "the positive direction.";
        draw_test(page, tests.front(), gallery);
        page.warnings.insert(page.warnings.end(),
                             tests.front().warnings.begin(),
                             tests.front().warnings.end());
      }
    page.write("Import of " + proposal.file.filename().string(),
               proposal.is_complete() ?
                 "Every line of the map was guessed: check that the pictures "
                 "show what you measured." :
                 "The map is incomplete: only you can fill in the open lines.",
               (problem.empty() ? "" : paragraph(problem, "problem")) +
                 problem_boxes(page.warnings) + gallery_section(gallery) +
                 columns_section(proposal) + guesses_section(proposal, map));
    return page.warnings;
  }
} // namespace SlipStep
