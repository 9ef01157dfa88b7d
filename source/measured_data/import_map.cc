// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/import_columns.h>
#include <slipstep/measured_data/import_record.h>

namespace SlipStep
{
  namespace
  {
    void declare_raw_file(Parameters &map)
    {
      using namespace dealii::Patterns;
      map.declare("Raw file/Name",
                  "",
                  Anything(),
                  "The file to convert, relative to the folder of this map or "
                  "the one on the command line. With wildcards, as in "
                  "runs/*_*N_?.txt, all files whose names match: * stands for "
                  "any characters, as few as possible, ? for one. What they "
                  "stand for replaces {1}, {2} and so on in sections Test and "
                  "Constants.");
      map.declare("Raw file/Delimiter",
                  "auto",
                  Selection("auto|tab|comma|semicolon|blanks"),
                  "Mark between columns. auto: tab, semicolon, comma or "
                  "blanks, the first of them that the header has.");
      map.declare("Raw file/Decimal mark",
                  "auto",
                  Selection("auto|point|comma"),
                  "Decimal mark of the numbers. auto: whichever they have; "
                  "both in one file are an error.");
      map.declare("Raw file/Header line",
                  "0",
                  Integer(0),
                  "Line with the names of the columns, counted from 1; lines "
                  "before it are skipped. 0: the first line that is neither "
                  "blank nor a comment.");
      map.declare("Raw file/Has header",
                  "true",
                  Bool(),
                  "false: columns are named by their number only, 'column 1', "
                  "and rows begin at the header line.");
      map.declare("Raw file/Units line",
                  "0",
                  Integer(0),
                  "Line with the units of the columns, counted from 1; rows "
                  "begin below it. 0: there is none.");
      map.declare("Raw file/Thousands mark",
                  "none",
                  Selection("none|point|comma|blank|apostrophe"),
                  "Mark that separates thousands, as in 1.234,5.");
      // A value in a .prm file cannot contain the mark itself.
      map.declare("Raw file/Comment marks",
                  "",
                  Anything(),
                  "Lines that begin with one of these words, separated by "
                  "commas, are skipped, as are those that begin with a hash.");
    }

    void declare_constants(Parameters &map)
    {
      const auto declare = [&](const std::string &name,
                               const std::string &text) {
        map.declare("Constants/" + name,
                    "",
                    dealii::Patterns::Anything(),
                    text + " With its unit, and with 'assumed' behind it if "
                           "nobody measured it, which the test then says; "
                           "empty: none.");
      };
      declare("Area",
              "Nominal contact area, to turn a normal load into a pressure.");
      declare("Pressure", "Nominal pressure, where no column has it.");
      declare("Normal load",
              "Normal load, where no column has it. If nobody knows it, '5 N "
              "assumed': all coefficients of friction are then in proportion "
              "to what is assumed.");
      declare("Speed", "Speed, where no column has the displacement.");
    }

    void declare_convention(Parameters &map)
    {
      using namespace dealii::Patterns;
      const std::string convention =
        "Friction is positive where it resists motion in the positive "
        "direction; reversed: the record has it the other way";
      map.declare("Convention/Friction sign",
                  "as recorded",
                  Selection("as recorded|reversed|of the motion"),
                  convention +
                    "; of the motion: friction in the record has no sign, and "
                    "takes that of the latest motion. A record with friction "
                    "that drives the motion is refused.");
      map.declare("Convention/Displacement sign",
                  "as recorded",
                  Selection("as recorded|reversed"),
                  convention + ".");
      map.declare("Convention/Start from zero",
                  "true",
                  Bool(),
                  "Whether time and displacement count from the first row.");
    }

    void declare_corrections(Parameters &map)
    {
      using dealii::Patterns::Anything;
      map.declare(
        "Correction/Zero",
        "none",
        Anything(),
        "What is subtracted from tangential load or coefficient as the zero of "
        "the sensor: 'mean of strokes', half the sum of the means over the "
        "forward and the backward path, 'mean of the first 2 s', or 'none'. "
        "The test says how much it was.");
      map.declare("Correction/Drift",
                  "none",
                  Anything(),
                  "'linear': a drift of the sensor that is linear in time, the "
                  "line that best fits the rows in motion, is subtracted from "
                  "the same column. Slow changes of friction are removed with "
                  "it; the test says how much it was.");
    }

    void declare_selection(Parameters &map)
    {
      using namespace dealii::Patterns;
      for (const std::string name : {"Begin", "End"})
        map.declare("Selection/" + name,
                    "",
                    Anything(),
                    "Time of the first and of the last row to be taken, by the "
                    "clock of the raw file, with its unit; empty: all rows.");
      map.declare(
        "Selection/Cut",
        "none",
        Anything(),
        "How a record becomes several tests: 'at reversals', 'every 5 cycles' "
        "(from turn to turn; rows before the first turn and after the last "
        "full part are left out), 'at holds of 2 s' (rests of at least 2 s; a "
        "part begins with a rest), 'after holds of 2 s' (a part begins with "
        "the last row of a rest), 'at 10 s, 20 s' (by the clock of the raw "
        "file), or 'none'.");
      map.declare(
        "Selection/Parts",
        "all",
        Anything(),
        "Which of the parts are wanted, as in '2, 4, 6 to 8'; counted "
        "from 1.");
      map.declare("Selection/Row step",
                  "1",
                  Integer(1),
                  "Take every n-th row. Extremes between these rows are lost, "
                  "unlike with 'Most rows'.");
      map.declare("Selection/Most rows",
                  "0",
                  Integer(0),
                  "Resample to at most this many rows, or fewer that describe "
                  "the record equally well: peaks, reversals and the onset of "
                  "motion are kept, and the noise of the full record is noted. "
                  "0: keep every row.");
    }

    void declare_test(Parameters &map)
    {
      const std::string places =
        " {1}, {2}: what the wildcards of Raw file/Name stood for; of parts "
        "(Selection/Cut), {part} is the number and {way} forth or back.";
      for (const std::string name :
           {"Name", "File", "Condition", "Source", "Licence", "Remark"})
        map.declare("Test/" + name,
                    "",
                    dealii::Patterns::Anything(),
                    (name == "Condition" ?
                       "Tests of the same condition are replicates." :
                     name == "File" ?
                       "Name of the converted file without its .csv; empty: "
                       "that of the variant or the raw file." :
                       "Written into the comments of the converted file.") +
                      places);
    }
  } // namespace



  void declare_import_parameters(Parameters &map)
  {
    declare_raw_file(map);
    for (const ColumnKey &key : column_keys())
      map.declare(
        "Columns/" + key.name,
        "",
        dealii::Patterns::Anything(),
        key.text +
          " 'NAME' or 'NAME in UNIT', as the header has it, or 'column 3 in "
          "UNIT'; a unit in the name, as in Load [N], or in the line of units "
          "need not be repeated. Or a formula with columns in braces, ({F in "
          "N} - 20*{p in bar})/{Fz in kN}: the columns are converted to mm, s, "
          "N, MPa, degC, {U as recorded} is not, and 'in UNIT' behind the "
          "formula is the unit of the result." +
          (key.dimension == Dimension::number ?
             "" :
             " Base unit: " + base_unit(key.dimension) + "."));
    declare_constants(map);
    declare_convention(map);
    declare_corrections(map);
    declare_selection(map);
    declare_test(map);
  }
} // namespace SlipStep
