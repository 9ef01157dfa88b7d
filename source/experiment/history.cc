// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/history.h>

#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

namespace SlipStep
{
  namespace
  {
    /// Call visit(name, member) for each column of history.csv, in their order:
    /// the only place that ties names to members, so that writing and reading
    /// cannot disagree.
    template <typename Row, typename Visit>
    void for_each_column(Row &row, const Visit &visit)
    {
      const auto spread = [&](const std::string &name, auto &of_face) {
        visit(name + "_mean", of_face.mean);
        visit(name + "_min", of_face.minimum);
        visit(name + "_max", of_face.maximum);
      };
      visit("time_s", row.time);
      visit("displacement_mm", row.displacement);
      visit("pressure_MPa", row.pressure);
      visit("friction", row.friction);
      visit("displacement_y_mm", row.displacement_y);
      visit("friction_y", row.friction_y);
      visit("normal_load_N", row.normal_load);
      visit("tangential_load_N", row.tangential_load);
      spread("r", row.loading_ratio);
      spread("r_s", row.normal_ratio);
      spread("mu", row.coefficient);
      visit("slip_fraction", row.slip_fraction);
      visit("dissipated_energy_Nmm", row.dissipated_energy);
      visit("stored_energy_Nmm", row.stored_energy);
      visit("external_work_Nmm", row.external_work);
      visit("step_s", row.step_size);
      visit("newton_iterations", row.newton_iterations);
      visit("linear_iterations", row.linear_iterations);
      visit("slip_mm", row.slip);
      visit("kinetic_energy_Nmm", row.kinetic_energy);
    }

    std::vector<std::string> column_names()
    {
      std::vector<std::string> names;
      const HistoryRow         any;
      for_each_column(any, [&](const std::string &name, const auto &) {
        names.push_back(name);
      });
      return names;
    }

    // "" if all values of the column are finite.
    std::string not_finite(const CsvTable &table, const std::string &column)
    {
      const auto &values = table[column];
      const auto  is_bad = [](const double value) {
        return !std::isfinite(value);
      };
      const auto n     = std::count_if(values.begin(), values.end(), is_bad);
      const auto first = std::find_if(values.begin(), values.end(), is_bad);
      return n == 0 ?
               "" :
               table.name() + ":" +
                 std::to_string(table.line(first - values.begin())) + ": " +
                 column + " is no finite number in " + std::to_string(n) +
                 " of " + std::to_string(values.size()) +
                 " rows, which are left out of pictures of it";
    }

    std::string text_of(const double number)
    {
      return exact_text(number);
    }

    std::string text_of(const unsigned int count)
    {
      return std::to_string(count);
    }
  } // namespace



  std::string probe_name(const std::size_t i)
  {
    return "probe_" + std::to_string(i + 1);
  }



  HistoryWriter::HistoryWriter(const std::filesystem::path      &file,
                               const std::vector<ContactMemory> &memories,
                               const std::size_t                 n_probes)
    : out(file)
    , file(file)
    , memories(memories)
  {
    if (!out)
      throw InputError(file.string() + ": this file cannot be written");
    std::vector<std::string> names = column_names();
    for (const ContactMemory &memory : memories)
      names.emplace_back(memory.name);
    for (std::size_t i = 0; i < n_probes; ++i)
      names.push_back(probe_name(i));
    out << boost::algorithm::join(names, ",") << '\n' << std::flush;
    if (!out)
      throw write_failure(file);
    size = out.tellp();
  }



  HistoryWriter::HistoryWriter(const std::filesystem::path      &file,
                               const std::uintmax_t              bytes,
                               const std::vector<ContactMemory> &memories)
    : file(file)
    , memories(memories)
    , size(bytes)
  {
    std::error_code error;
    std::filesystem::resize_file(file, bytes, error);
    out.open(file, std::ios::app);
    if (error || !out)
      throw RunError(file.string() + ": this file cannot be continued");
  }



  void HistoryWriter::write(const HistoryRow &row)
  {
    std::vector<std::string> cells;
    for_each_column(row, [&](const std::string &, const auto &value) {
      cells.push_back(text_of(value));
    });
    for (const ContactMemory &memory : memories)
      cells.push_back(exact_text(row.memories[memory.slot]));
    for (const double probe : row.probes)
      cells.push_back(exact_text(probe));
    const std::string line = boost::algorithm::join(cells, ",");
    out << line << '\n' << std::flush;
    // A file that somebody deleted takes rows that nobody will see.
    std::error_code gone;
    if (!std::filesystem::exists(file, gone))
      throw write_failure(file, ENOENT);
    if (!out)
      {
        // What there is of this row would make the file unreadable.
        const int reason = errno;
        out.close();
        std::error_code error;
        std::filesystem::resize_file(file, size, error);
        throw write_failure(file, reason);
      }
    size += line.size() + 1;
  }



  std::vector<HistoryRow> read_history(const std::filesystem::path    &file,
                                       std::vector<std::string> *const warnings)
  {
    // Older files have no kinetic energy.
    const std::vector<std::string> all = column_names();
    std::vector<std::string>       names(all.begin(), all.end() - 1);
    std::vector<std::string>       others = {all.back()};
    std::vector<std::string>       probes;
    for (std::size_t i = 0; i < most_probes; ++i)
      probes.push_back(probe_name(i));
    others.insert(others.end(), probes.begin(), probes.end());
    for (const ContactMemory &memory : contact_memories())
      others.emplace_back(memory.name);
    CsvFormat format;
    format.may_be_cut = true;
    const CsvTable table(file, names, others, format);

    std::vector<const std::vector<double> *> columns;
    for (const std::string &name : all)
      columns.push_back(&table[name]);
    if (warnings != nullptr)
      {
        std::vector<std::string> told = all;
        for (const ContactMemory &memory : contact_memories())
          told.emplace_back(memory.name);
        for (const std::string &name : told)
          if (const std::string why = not_finite(table, name); !why.empty())
            warnings->push_back(why);
      }
    std::vector<HistoryRow> history(table.size());
    for (const std::string &probe : probes)
      if (table.has(probe))
        for (std::size_t row = 0; row < history.size(); ++row)
          history[row].probes.push_back(table[probe][row]);
    for (const ContactMemory &memory : contact_memories())
      if (table.has(memory.name))
        for (std::size_t row = 0; row < history.size(); ++row)
          history[row].memories[memory.slot] = table[memory.name][row];
    for (std::size_t row = 0; row < history.size(); ++row)
      {
        std::size_t i = 0;
        for_each_column(history[row], [&](const std::string &, auto &value) {
          const std::vector<double> &column = *columns[i++];
          if (!column.empty())
            value = static_cast<std::decay_t<decltype(value)>>(column[row]);
        });
      }
    return history;
  }
} // namespace SlipStep
