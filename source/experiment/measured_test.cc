#include <slipstep/experiment/measured_test.h>

#include <slipstep/utilities/csv.h>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    void check_rows(const CsvTable                 &table,
                    const std::vector<std::string> &columns)
    {
      for (const std::string &column : columns)
        for (std::size_t row = 0; row < table[column].size(); ++row)
          if (!std::isfinite(table[column][row]))
            table.reject(row, column, column + " is not finite");

      const std::vector<double> &time = table["time_s"];
      for (std::size_t row = 1; row < time.size(); ++row)
        if (time[row] <= time[row - 1])
          table.reject(row,
                       "time_s",
                       "time must increase: " + exact_text(time[row]) +
                         " s follows " + exact_text(time[row - 1]) + " s");

      const std::vector<double> &pressure = table["pressure_MPa"];
      for (std::size_t row = 0; row < pressure.size(); ++row)
        if (pressure[row] < 0.)
          table.reject(row,
                       "pressure_MPa",
                       "pressure is " + exact_text(pressure[row]) +
                         " MPa, but must not be negative");
    }
  } // namespace



  MeasuredTest read_measured_test(const std::filesystem::path &file)
  {
    const std::vector<std::string> required = {"time_s",
                                               "displacement_mm",
                                               "pressure_MPa",
                                               "friction"};
    const std::vector<std::string> optional = {"displacement_y_mm",
                                               "friction_y",
                                               "temperature_C"};

    const CsvTable table(file, required, optional);
    check_rows(table, required);
    check_rows(table, optional);
    if (table.size() < 2)
      throw InputError(file.string() + ": a test needs at least two rows, " +
                       std::to_string(table.size()) + " found");

    MeasuredTest test;
    test.notes = table.comments();
    test.name =
      test.notes.count("name") ? test.notes.at("name") : file.stem().string();
    test.condition =
      test.notes.count("condition") ? test.notes.at("condition") : "";
    test.time           = table["time_s"];
    test.displacement   = table["displacement_mm"];
    test.pressure       = table["pressure_MPa"];
    test.friction       = table["friction"];
    test.displacement_y = table["displacement_y_mm"];
    test.friction_y     = table["friction_y"];
    test.temperature    = table["temperature_C"];
    return test;
  }
} // namespace SlipStep
