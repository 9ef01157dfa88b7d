// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/history.h>

#include <slipstep/utilities/csv.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <functional>
#include <string>

namespace SlipStep
{
  namespace
  {
    /// One column of history.csv: the only place that ties names to members,
    /// so that writing and reading cannot disagree.
    struct Column
    {
      const char *name;
      /// The member, or null for a count.
      std::function<double &(HistoryRow &)>       number;
      std::function<unsigned int &(HistoryRow &)> count;
    };

    Column number(const char *name, double HistoryRow::*member)
    {
      return {name,
              [member](HistoryRow &row) -> double & { return row.*member; },
              nullptr};
    }

    Column
    spread(const char *name, Spread HistoryRow::*member, double Spread::*part)
    {
      return {name,
              [member, part](HistoryRow &row) -> double & {
                return (row.*member).*part;
              },
              nullptr};
    }

    Column count(const char *name, unsigned int HistoryRow::*member)
    {
      return {name, nullptr, [member](HistoryRow &row) -> unsigned int & {
                return row.*member;
              }};
    }

    const std::vector<Column> &columns()
    {
      using Row                            = HistoryRow;
      static const std::vector<Column> all = {
        number("time_s", &Row::time),
        number("displacement_mm", &Row::displacement),
        number("pressure_MPa", &Row::pressure),
        number("friction", &Row::friction),
        number("displacement_y_mm", &Row::displacement_y),
        number("friction_y", &Row::friction_y),
        number("normal_load_N", &Row::normal_load),
        number("tangential_load_N", &Row::tangential_load),
        spread("r_mean", &Row::loading_ratio, &Spread::mean),
        spread("r_min", &Row::loading_ratio, &Spread::minimum),
        spread("r_max", &Row::loading_ratio, &Spread::maximum),
        spread("r_s_mean", &Row::normal_ratio, &Spread::mean),
        spread("r_s_min", &Row::normal_ratio, &Spread::minimum),
        spread("r_s_max", &Row::normal_ratio, &Spread::maximum),
        spread("mu_mean", &Row::coefficient, &Spread::mean),
        spread("mu_min", &Row::coefficient, &Spread::minimum),
        spread("mu_max", &Row::coefficient, &Spread::maximum),
        number("slip_fraction", &Row::slip_fraction),
        number("dissipated_energy_Nmm", &Row::dissipated_energy),
        number("stored_energy_Nmm", &Row::stored_energy),
        number("external_work_Nmm", &Row::external_work),
        number("step_s", &Row::step_size),
        count("newton_iterations", &Row::newton_iterations),
        count("linear_iterations", &Row::linear_iterations),
        number("slip_mm", &Row::slip),
        number("kinetic_energy_Nmm", &Row::kinetic_energy)};
      return all;
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
    const char *separator = "";
    for (const Column &column : columns())
      {
        out << separator << column.name;
        separator = ",";
      }
    for (const ContactMemory &memory : memories)
      out << ',' << memory.name;
    for (std::size_t i = 0; i < n_probes; ++i)
      out << ',' << probe_name(i);
    out << '\n' << std::flush;
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
    HistoryRow  values = row;
    std::string line;
    for (const Column &column : columns())
      {
        if (!line.empty())
          line += ',';
        line += column.number ? exact_text(column.number(values)) :
                                std::to_string(column.count(values));
      }
    for (const ContactMemory &memory : memories)
      line += ',' + exact_text(row.memories[memory.slot]);
    for (const double probe : row.probes)
      line += ',' + exact_text(probe);
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



  std::vector<HistoryRow> read_history(const std::filesystem::path &file)
  {
    // Older files have no kinetic energy.
    std::vector<std::string> names, others;
    for (const Column &column : columns())
      (column.name == std::string("kinetic_energy_Nmm") ? others : names)
        .emplace_back(column.name);
    std::vector<std::string> probes;
    for (std::size_t i = 0; i < most_probes; ++i)
      probes.push_back(probe_name(i));
    others.insert(others.end(), probes.begin(), probes.end());
    for (const ContactMemory &memory : contact_memories())
      others.emplace_back(memory.name);
    CsvFormat format;
    format.may_be_cut = true;
    const CsvTable table(file, names, others, format);

    std::vector<HistoryRow> history(table.size());
    for (const std::string &probe : probes)
      if (table.has(probe))
        for (std::size_t row = 0; row < history.size(); ++row)
          history[row].probes.push_back(table[probe][row]);
    for (const ContactMemory &memory : contact_memories())
      if (table.has(memory.name))
        for (std::size_t row = 0; row < history.size(); ++row)
          history[row].memories[memory.slot] = table[memory.name][row];
    for (const Column &column : columns())
      {
        if (!table.has(column.name))
          continue;
        const std::vector<double> &values = table[column.name];
        for (std::size_t row = 0; row < values.size(); ++row)
          if (column.number)
            column.number(history[row]) = values[row];
          else
            column.count(history[row]) = static_cast<unsigned int>(values[row]);
      }
    return history;
  }
} // namespace SlipStep
