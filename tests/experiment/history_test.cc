// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/history.h>
#include <slipstep/measured_data/measured_test.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/file_text.h"
#include "tests/message_of.h"
#include "tests/temporary_folder.h"

using namespace SlipStep;

namespace
{
  std::filesystem::path history_file()
  {
    return test_folder() / "history.csv";
  }

  std::vector<double *> numbers_of(HistoryRow &row)
  {
    return {&row.time,
            &row.displacement,
            &row.pressure,
            &row.friction,
            &row.displacement_y,
            &row.friction_y,
            &row.normal_load,
            &row.tangential_load,
            &row.loading_ratio.mean,
            &row.loading_ratio.minimum,
            &row.loading_ratio.maximum,
            &row.normal_ratio.mean,
            &row.normal_ratio.minimum,
            &row.normal_ratio.maximum,
            &row.coefficient.mean,
            &row.coefficient.minimum,
            &row.coefficient.maximum,
            &row.slip_fraction,
            &row.dissipated_energy,
            &row.stored_energy,
            &row.external_work,
            &row.step_size,
            &row.slip,
            &row.kinetic_energy};
  }

  /// A row in which every member has its own, not exactly printable value.
  HistoryRow sample_row()
  {
    HistoryRow row;
    double     value = 1. / 3.;
    for (double *member : numbers_of(row))
      *member = (value *= -1.7e-3 / 0.9e-3);
    row.newton_iterations = 3;
    row.linear_iterations = 4000000000u;
    return row;
  }
} // namespace



// Users and scripts read these columns: a change here is a change for them.
TEST(History, TheColumnsAreTheDocumentedOnes)
{
  HistoryWriter{history_file()};
  std::ifstream in(history_file());
  std::string   line;
  std::getline(in, line);
  EXPECT_EQ(line,
            "time_s,displacement_mm,pressure_MPa,friction,displacement_y_mm,"
            "friction_y,normal_load_N,tangential_load_N,r_mean,r_min,r_max,"
            "r_s_mean,r_s_min,r_s_max,mu_mean,mu_min,mu_max,slip_fraction,"
            "dissipated_energy_Nmm,stored_energy_Nmm,external_work_Nmm,step_s,"
            "newton_iterations,linear_iterations,slip_mm,kinetic_energy_Nmm");
}



TEST(History, OnlyMemoriesThatTheLawUsesAreColumns)
{
  HistoryRow  row;
  const auto &age  = contact_memory("contact_age_s"),
             &hold = contact_memory("hold_time_s"),
             &heat = contact_memory("temperature_rise_degC");
  for (const ContactMemory &memory : contact_memories())
    row.memories[memory.slot] = (memory.slot + 1) / 3.;
  row.probes = {7.};
  HistoryWriter(history_file(), {age, heat}, 1).write(row);
  std::ifstream in(history_file());
  std::string   header;
  std::getline(in, header);
  const std::string end =
    ",kinetic_energy_Nmm,contact_age_s,temperature_rise_degC,probe_1";
  ASSERT_GT(header.size(), end.size());
  EXPECT_EQ(header.substr(header.size() - end.size()), end);

  const HistoryRow back = read_history(history_file())[0];
  EXPECT_EQ(back.memories[age.slot], row.memories[age.slot]);
  EXPECT_EQ(back.memories[hold.slot], 0.);
  EXPECT_EQ(back.memories[heat.slot], row.memories[heat.slot]);
  EXPECT_EQ(back.probes, row.probes);

  // Continued after a stop, it goes on with the same columns.
  const auto bytes = std::filesystem::file_size(history_file());
  HistoryWriter(history_file(), bytes, {age, heat}).write(row);
  EXPECT_EQ(read_history(history_file())[1].memories, back.memories);
}



// The kernel may be stopped within a write; what is there of a number may look
// like a number.
TEST(History, ARowThatAKillCutOffIsNone)
{
  HistoryWriter writer(history_file());
  writer.write(sample_row());
  const auto one_row = writer.bytes();
  writer.write(sample_row());
  for (auto bytes = writer.bytes() - 1; bytes >= one_row; bytes -= 7)
    {
      std::filesystem::resize_file(history_file(), bytes);
      EXPECT_EQ(read_history(history_file()).size(), 1u) << bytes;
    }
}



TEST(History, RowsReadBackExactly)
{
  HistoryRow    row = sample_row();
  HistoryWriter writer(history_file());
  writer.write(row);
  writer.write(row);

  std::vector<HistoryRow> rows = read_history(history_file());
  ASSERT_EQ(rows.size(), 2u);
  const auto wanted = numbers_of(row), read = numbers_of(rows[1]);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_EQ(*read[i], *wanted[i]) << i;
  EXPECT_EQ(rows[1].newton_iterations, row.newton_iterations);
  EXPECT_EQ(rows[1].linear_iterations, row.linear_iterations);
}



TEST(History, OfAnOlderProgramHasNoKineticEnergy)
{
  HistoryWriter(history_file()).write(sample_row());
  std::ifstream in(history_file());
  std::string   text;
  for (std::string line; std::getline(in, line);)
    text += line.substr(0, line.rfind(',')) + '\n';
  in.close();
  std::ofstream(history_file()) << text;
  const std::vector<HistoryRow> rows = read_history(history_file());
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].slip, sample_row().slip);
  EXPECT_EQ(rows[0].kinetic_energy, 0.);
}



TEST(History, TheFileIsCompleteAfterEveryRow)
{
  HistoryWriter writer(history_file());
  for (unsigned int n = 1; n < 4; ++n)
    {
      writer.write(sample_row());
      EXPECT_EQ(read_history(history_file()).size(), n);
    }
}



TEST(History, AnUndefinedRatioSurvives)
{
  HistoryRow row;
  row.friction = std::nan("");
  HistoryWriter(history_file()).write(row);
  EXPECT_TRUE(std::isnan(read_history(history_file())[0].friction));
}



// Undefined probes are no reason to warn.
TEST(History, NumbersThatAreNotFiniteAreTold)
{
  HistoryRow    row = sample_row();
  HistoryWriter writer(history_file(), {}, 1);
  row.probes = {std::nan("")};
  writer.write(row);
  std::vector<std::string> warnings;
  read_history(history_file(), &warnings);
  EXPECT_TRUE(warnings.empty());
  row.friction = std::nan("");
  writer.write(row);
  row.time = HUGE_VAL;
  writer.write(row);
  read_history(history_file(), &warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(
    contains(warnings[0], ".csv:4: time_s is no finite number in 1 of 3 rows"));
  EXPECT_TRUE(contains(warnings[1],
                       ".csv:3: friction is no finite number in 2 of 3 rows"));
}



TEST(History, AFolderThatDoesNotExistIsReported)
{
  EXPECT_THROW(HistoryWriter("no/such/folder/history.csv"), InputError);
}



TEST(History, ADamagedFileIsReported)
{
  HistoryWriter(history_file()).write(sample_row());
  std::ofstream(history_file(), std::ios::app) << "1,2,3\n";
  EXPECT_TRUE(
    contains(message_of([] { read_history(history_file()); }), ".csv:3:"));
}



TEST(History, ItReadsAsAMeasuredTest)
{
  const auto    file = test_folder() / "as_test.csv";
  HistoryWriter writer(file, contact_memories());
  HistoryRow    row;
  row.pressure = 5.8;
  writer.write(row);
  row.time           = 0.1;
  row.friction       = 0.1 / 3.;
  row.displacement_y = 0.2;
  writer.write(row);

  const MeasuredTest test = read_measured_test(file);
  EXPECT_EQ(test.name, "as_test");
  EXPECT_EQ(test.friction[1], row.friction);
  EXPECT_EQ(test.displacement_y.size(), 2u);
}
